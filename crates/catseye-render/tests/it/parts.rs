//! Parts of a picture give exactly the picture, and what is not a part of it is refused.

use std::sync::atomic::AtomicBool;

use catseye::Model;
use catseye_render::{Error, Film, Lighting, Part, Region, RenderSettings, Scene, expose, render};

const SPP: u32 = 5;

fn settings() -> RenderSettings {
    RenderSettings { width: 50, height: 35, spp: SPP, ..RenderSettings::default() }
}

fn scene() -> Scene {
    Scene::builtin(None, Model::Reciprocal).expect("a scene")
}

fn film(scene: &Scene, settings: &RenderSettings, region: Option<Region>, [start, end]: [u32; 2]) -> Film {
    let mut film = Film::new(scene, settings, region, start).expect("settings in range");
    assert!(
        expose(scene, settings, &mut film, end - start, &AtomicBool::new(false), &|_| ())
            .expect("the same picture")
    );
    film
}

fn region([x0, y0]: [usize; 2], [x1, y1]: [usize; 2]) -> Option<Region> {
    Some(Region { start: [x0, y0], end: [x1, y1] })
}

fn through_a_file(film: Film, scene: &Scene) -> Film {
    let (tone_map, info) = (*scene.tone_map(), scene.info().clone());
    let part = Part { film, oversampling: 2, tone_map, info };
    let file = part.encode().expect("a picture");
    let read = Part::decode(&file).expect("what was written");
    assert_eq!(read.film, part.film);
    assert_eq!((read.oversampling, read.tone_map), (2, part.tone_map));
    assert_eq!((read.info.units, read.info.lamp_deg), (part.info.units, part.info.lamp_deg));
    read.film
}

#[test]
fn parts_in_any_order_give_the_bits_of_the_picture() {
    let (scene, settings) = (scene(), settings());
    let whole = render(&scene, &settings, &|_| ()).unwrap();
    let parts = [
        film(&scene, &settings, region([0, 0], [50, 20]), [3, 5]),
        film(&scene, &settings, region([0, 20], [17, 35]), [0, 5]),
        film(&scene, &settings, region([0, 0], [50, 20]), [0, 3]),
        film(&scene, &settings, region([17, 20], [50, 35]), [0, 5]),
    ];
    let parts = parts.map(|film| through_a_file(film, &scene));
    assert!(Film::merge(&parts, Some(0..SPP)).unwrap().image() == whole);
    // Going on with a film is the same as exposing it at once.
    let mut film = film(&scene, &settings, None, [0, 2]);
    expose(&scene, &settings, &mut film, SPP - 2, &AtomicBool::new(false), &|_| ()).unwrap();
    assert!(film.image() == whole);
}

#[test]
fn what_does_not_fit_is_refused_and_named() {
    let (scene, settings) = (scene(), settings());
    let of = |region, samples| film(&scene, &settings, region, samples);
    let [left, right] = [region([0, 0], [20, 35]), region([20, 0], [50, 35])];
    let whole = of(None, [0, 1]);
    let problem = |parts: &[Film], samples| Film::merge(parts, samples).unwrap_err().to_string();

    assert!(matches!(Film::merge(&[], None), Err(Error::NoParts)));
    let gap = [of(left, [0, 2]), of(right, [0, 1])];
    assert_eq!(problem(&gap, None), "no part has the samples 1..2 of the pixel in column 20 and row 0");
    assert_eq!(problem(&gap[..1], None), "no part has the samples 0..2 of the pixel in column 20 and row 0");
    assert_eq!(
        problem(std::slice::from_ref(&whole), Some(0..2)),
        "no part has the samples 1..2 of the pixel in column 0 and row 0"
    );
    let overlap = [whole.clone(), of(None, [1, 2]), of(left, [1, 2])];
    assert_eq!(problem(&overlap, None), "parts 1 and 2 both have the samples 1..2 of some pixels");
    assert_eq!(problem(&overlap[..2], Some(0..1)), "part 1 has the samples 1..2, beyond 0..1");

    let other = RenderSettings { seed: 1, ..settings.clone() };
    let other = film(&scene, &other, None, [1, 2]);
    assert_eq!(problem(&[whole.clone(), other], None), "parts 0 and 1: different seeds: 0 and 1");
    let lighting = Lighting { model: Model::Edwards, lamp_deg: None };
    let edwards = film(&Scene::builtin(None, lighting).unwrap(), &settings, None, [1, 2]);
    let message = "parts 0 and 1: different scenes, materials, lamps or exposures";
    assert_eq!(problem(&[whole, edwards], None), message);
    assert!(Film::new(&scene, &settings, region([0, 0], [51, 1]), 0).is_err());
    assert!(Film::new(&scene, &settings, region([7, 0], [7, 1]), 0).is_err());
}

#[test]
fn a_film_that_is_stopped_is_as_it_was() {
    let (scene, settings) = (scene(), settings());
    let before = film(&scene, &settings, None, [0, 1]);
    let mut film = before.clone();
    assert!(!expose(&scene, &settings, &mut film, 4, &AtomicBool::new(true), &|_| ()).unwrap());
    assert_eq!(film, before);
}

#[test]
fn damaged_parts_are_refused() {
    let (scene, settings) = (scene(), settings());
    let film = film(&scene, &settings, None, [0, 1]);
    let part = Part { film, oversampling: 1, tone_map: *scene.tone_map(), info: scene.info().clone() };
    let file = part.encode().unwrap();
    for length in (0..file.len()).step_by(file.len() / 97) {
        assert!(matches!(Part::decode(&file[..length]), Err(Error::Part { .. })), "{length} bytes");
    }
    let head = file.len().min(3000);
    for at in 0..head {
        let mut damaged = file.clone();
        damaged[at] ^= 0x55;
        // Some bytes are names and comments; what matters is that nothing worse than an error happens.
        drop(Part::decode(&damaged));
    }
}

#[test]
fn the_same_part_is_the_same_file() {
    let (scene, settings) = (scene(), settings());
    let encode = || {
        let film = film(&scene, &settings, region([3, 4], [20, 30]), [2, 4]);
        Part { film, oversampling: 2, tone_map: *scene.tone_map(), info: scene.info().clone() }
            .encode()
            .unwrap()
    };
    assert!(encode() == encode());
}
