//! Files are written whole or not at all.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use catseye_render::{Error, Image, ToneMap, write_exr, write_png, write_whole};

fn picture() -> Image {
    Image::from_fn(5, 3, |x, y| [x as f32 * 0.25, y as f32 * 100.0, 0.5])
}

fn entries(folder: &Path) -> usize {
    fs::read_dir(folder).expect("the folder is there").count()
}

#[test]
fn exr_keeps_every_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.exr");
    write_exr(&picture(), &path).unwrap();
    let read = exr::prelude::read_first_rgba_layer_from_file(
        &path,
        |size, _| Image::new(size.width(), size.height()),
        |image, at, (r, g, b, _): (f32, f32, f32, f32)| image.set_pixel(at.x(), at.y(), [r, g, b]),
    )
    .unwrap();
    assert_eq!(read.layer_data.channel_data.pixels, picture());
    assert_eq!(entries(folder.path()), 1);
}

#[test]
fn png_is_srgb_of_the_tone_map() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    write_png(&picture(), &ToneMap::LINEAR, &path).unwrap();
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    assert_eq!(&bytes[..6], &[0, 0, 188, 137, 0, 188]);
    assert_eq!(bytes[5 * 3 + 1], 255);
}

#[test]
fn a_missing_folder_is_an_error_that_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("missing/picture.png");
    let error = write_png(&picture(), &ToneMap::default(), &path).unwrap_err();
    assert!(error.to_string().contains(&path.display().to_string()), "{error}");
    assert!(matches!(write_exr(&picture(), &path), Err(Error::Write { .. })));
    assert_eq!(entries(folder.path()), 0);
}

#[test]
fn a_folder_in_the_way_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("taken");
    fs::create_dir(&path).unwrap();
    assert!(matches!(write_png(&picture(), &ToneMap::default(), &path), Err(Error::Write { .. })));
    assert_eq!(entries(folder.path()), 1);
}

#[test]
fn a_failure_half_way_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    fs::write(&path, "old").unwrap();
    let result = write_whole(&path, |file| {
        file.write_all(b"half of the new")?;
        Err(std::io::Error::other("the disk is full"))
    });
    assert!(result.unwrap_err().to_string().ends_with("the disk is full"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(entries(folder.path()), 1);
}
