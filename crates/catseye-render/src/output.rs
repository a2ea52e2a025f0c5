//! Writing pictures, whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::path::Path;

use crate::tone::encode_srgb;
use crate::{Error, Image, ToneMap};

/// Writes an 8-bit sRGB PNG.
///
/// The file appears under its name only when it is complete; on an error nothing is left behind.
///
/// # Errors
/// The file can't be written.
pub fn write_png(image: &Image, tone_map: &ToneMap, path: &Path) -> Result<(), Error> {
    let shown = image.toned(tone_map);
    let bytes: Vec<u8> = shown.pixels().iter().flat_map(|pixel| pixel.map(encode_srgb)).collect();
    write_whole(path, |file| {
        let mut encoder = png::Encoder::new(file, image.width() as u32, image.height() as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        Ok(writer.finish()?)
    })
}

/// Writes a 32-bit float EXR of linear Rec. 709 radiance.
///
/// The file appears under its name only when it is complete; on an error nothing is left behind.
///
/// # Errors
/// The file can't be written.
pub fn write_exr(image: &Image, path: &Path) -> Result<(), Error> {
    use exr::prelude::{Image as ExrImage, SpecificChannels, WritableImage as _};
    let channels = SpecificChannels::rgb(|at: exr::math::Vec2<usize>| {
        let [r, g, b] = image.pixel(at.x(), at.y());
        (r, g, b)
    });
    let exr_image = ExrImage::from_channels((image.width(), image.height()), channels);
    write_whole(path, |file| {
        exr_image.write().to_buffered(file).map_err(|e| match e {
            exr::error::Error::Io(e) => e,
            other => io::Error::other(other.to_string()),
        })
    })
}

/// Writes a file under a temporary name beside its own, and renames it when it is complete.
///
/// # Errors
/// The folder isn't there or can't be written to, or `write` fails; nothing is left behind then.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), Error> {
    let attempt = || {
        // A directory can't be replaced by a file: say so before anything is computed and written.
        if path.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "is a directory"));
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let temporary = temporary_file(folder)?;
        {
            let mut file = BufWriter::new(temporary.as_file());
            write(&mut file)?;
            file.flush()?;
        }
        temporary.persist(path).map_err(|e| e.error)?;
        Ok(())
    };
    attempt().map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// A file with the permissions that any new file gets, deleted unless it is renamed.
fn temporary_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catseye-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
