//! A picture depends on its scene and settings only.

use catseye::Model;
use catseye_render::{RenderSettings, Scene, render};

fn settings(threads: Option<usize>, seed: u32) -> RenderSettings {
    RenderSettings { width: 75, height: 41, spp: 2, threads, seed, ..RenderSettings::default() }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let scene = Scene::builtin(None, Model::Reciprocal).unwrap();
    let one = render(&scene, &settings(Some(1), 0), &|_| ()).unwrap();
    for threads in [Some(2), Some(5), None] {
        let other = render(&scene, &settings(threads, 0), &|_| ()).unwrap();
        assert!(one == other, "{threads:?} threads");
    }
}

#[test]
fn the_scene_built_again_gives_the_same_bits() {
    let picture =
        || render(&Scene::builtin(None, Model::Reciprocal).unwrap(), &settings(None, 0), &|_| ()).unwrap();
    assert!(picture() == picture());
}

#[test]
fn another_seed_gives_other_noise_only() {
    let scene = Scene::builtin(None, Model::Reciprocal).unwrap();
    let [a, b] = [0, 1].map(|seed| render(&scene, &settings(None, seed), &|_| ()).unwrap());
    assert!(a != b);
    // As a screen shows it: the mean of the light is that of a few studs, which samples hit or miss.
    let [a, b] = [a, b].map(|image| image.toned(scene.tone_map()).mean()[1]);
    assert!((a / b - 1.0).abs() < 0.1, "{a} {b}");
}

#[test]
fn progress_ends_at_one() {
    let scene = Scene::builtin(None, Model::Reciprocal).unwrap();
    let last = std::sync::Mutex::new(0.0_f32);
    render(&scene, &settings(None, 0), &|done| {
        let mut last = last.lock().unwrap();
        *last = last.max(done);
    })
    .unwrap();
    assert_eq!(*last.lock().unwrap(), 1.0);
}

#[test]
fn bad_settings_are_errors_that_name_the_field() {
    let scene = Scene::builtin(None, Model::Reciprocal).unwrap();
    let good = settings(None, 0);
    for (name, bad) in [
        ("width", RenderSettings { width: 0, ..good.clone() }),
        ("height", RenderSettings { height: 100_000, ..good.clone() }),
        ("spp", RenderSettings { spp: 0, ..good.clone() }),
        ("threads", RenderSettings { threads: Some(0), ..good.clone() }),
    ] {
        let error = render(&scene, &bad, &|_| ()).unwrap_err().to_string();
        assert!(error.starts_with(name), "{error}");
    }
}
