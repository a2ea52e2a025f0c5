//! Promise: measured BRDFs are read as what they are, and files that are none are refused.

use catseye::{Lobe as _, Params, Reciprocal, Vec3};
use catseye_photometry::brdf::{Brdf, Cosine, Metrics, Selection, Skipped, metrics};
use catseye_photometry::fit::{EntranceKind, FitOptions, fit};
use catseye_photometry::{Apertures, EntranceLaw, Error, Geometry, RetroLobe, Sheeting};

fn lobe() -> Reciprocal<f64> {
    let params = Params::isotropic(0.08).with_tint([0.9, 0.5, 0.1]).with_multiscatter_tint([0.5; 3]);
    Reciprocal::new(&params).unwrap()
}

const HEADER: &str = "#SAMPLE \"ours\"\n# a comment\n#DIM 3 1\n#VS 0\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n";

/// Light at 15, 30 and 60 degrees, the view on a grid of 5 degrees: the layout of the retro-reflective tapes'
/// files.
fn alta(lobe: &Reciprocal<f64>, header: &str, with_cosine: bool) -> String {
    let mut text = header.to_owned();
    for light in [15.0_f64, 30.0, 60.0].map(f64::to_radians) {
        for (i, j) in (-17..=17).flat_map(|i| (-17..=17).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| (5.0 * f64::from(k)).to_radians());
            if x.hypot(y) < 1.5 {
                let wo = Vec3::from_angles(x.hypot(y), y.atan2(x));
                let f = lobe.eval(wo, Vec3::from_angles(light, 0.0))[1];
                let value = if with_cosine { f * wo.z } else { f };
                text += &format!("{light:.17} {x:.17}\t{y:.17} {value:.17e}\n");
            }
        }
    }
    text
}

fn assert_is(brdf: &Brdf, lobe: &Reciprocal<f64>, channels: [usize; 3], tolerance: f64) {
    for sample in &brdf.samples {
        let expected = lobe.eval(sample.wo, sample.wi);
        for (value, channel) in sample.value.into_iter().zip(channels) {
            let expected = expected[channel];
            assert!((value - expected).abs() <= tolerance * expected, "{sample:?}: {expected}");
        }
    }
}

#[test]
fn alta_text_is_the_brdf_with_and_without_cosine() {
    for (out, with_cosine) in [("INV_STERADIAN", false), ("INV_STERADIAN_COSINE_FACTOR", true)] {
        let header = format!("{HEADER}#PARAM_OUT {out}\n");
        let brdf =
            Brdf::parse(alta(&lobe(), &header, with_cosine).as_bytes(), "a.dat", Cosine::AsStated).unwrap();
        assert!(brdf.samples.len() > 2500 && brdf.skipped == Skipped::default() && brdf.remarks.is_empty());
        // The directions' rounding, seen on the flank of the lobe.
        assert_is(&brdf, &lobe(), [1; 3], 1e-9);
    }
}

#[test]
fn a_header_that_the_values_contradict_is_refused() {
    let stated = format!("{HEADER}#PARAM_OUT INV_STERADIAN\n");
    let read = |text: &str, cosine| Brdf::parse(text.as_bytes(), "a.dat", cosine).unwrap();
    let text = alta(&lobe(), &stated, true);
    let error = |text: &str| Brdf::parse(text.as_bytes(), "a.dat", Cosine::AsStated).unwrap_err();
    let believed = error(&text);
    assert!(matches!(believed, Error::Cosine { found, .. } if found.included), "{believed}");
    assert!(
        believed.to_string().starts_with("a.dat: ") && believed.to_string().contains("as they were read")
    );
    let told = read(&text, Cosine::Included);
    assert!(told.remarks.is_empty());
    assert_is(&told, &lobe(), [1; 3], 1e-9);

    let wrong = alta(&lobe(), &format!("{HEADER}#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n"), false);
    assert!(matches!(error(&wrong), Error::Cosine { found, .. } if !found.included));
    // Whoever insists is told.
    let insisted = read(&text, Cosine::Excluded).remarks;
    assert!(insisted[0].contains("if values are f times the receiver's cosine"), "{insisted:?}");

    let silent = read(&alta(&lobe(), HEADER, false), Cosine::AsStated);
    assert!(silent.remarks[0].contains("#PARAM_OUT is missing"), "{:?}", silent.remarks);
}

#[test]
fn every_parametrisation_means_the_same_directions() {
    let wo = Vec3::<f64>::from_angles(0.7, 0.4);
    let wi = Vec3::<f64>::from_angles(0.5, -0.3);
    let azimuth = 0.7_f64;
    // Half vector and difference by hand: both directions stand at the angle d from it.
    let half = Vec3::new(wo.x + wi.x, wo.y + wi.y, wo.z + wi.z).normalized();
    let (theta, phi) = (half.z.acos(), half.y.atan2(half.x));
    let d = 0.5 * wo.dot(wi).acos();
    let turned = Vec3::new(wo.x * phi.cos() + wo.y * phi.sin(), wo.y * phi.cos() - wo.x * phi.sin(), wo.z);
    let p = turned.y.atan2(turned.x * theta.cos() - turned.z * theta.sin());
    let (px, py) = (0.7 * azimuth.cos(), 0.7 * azimuth.sin());
    let full = |x: &[f64]| x.iter().map(|x| format!("{x:.17} ")).collect::<String>();
    for (name, numbers, anisotropic) in [
        ("ISOTROPIC_TL_TV_PROJ_DPHI", full(&[0.5, px, py]), false),
        ("ISOTROPIC_TV_TL_DPHI", full(&[0.7, 0.5, -azimuth]), false),
        ("RUSIN_TH_TD_PD", full(&[theta, d, p]), false),
        ("RUSIN_TH_PH_TD_PD", full(&[theta, phi, d, p]), true),
        ("SPHERICAL_TL_PL_TV_PV", full(&[0.5, -0.3, 0.7, 0.4]), true),
        ("CARTESIAN", full(&[wo.x, wo.y, wo.z, wi.x, wi.y, wi.z]), true),
    ] {
        let n = numbers.split_whitespace().count();
        let text = format!("#DIM {n} 3\n#PARAM_IN {name}\n#PARAM_OUT RGB_COLOR\n{numbers} 1 2 3 0.5 0.5\n");
        let brdf = Brdf::parse(text.as_bytes(), "a.dat", Cosine::AsStated).unwrap();
        let sample = brdf.samples[0];
        assert_eq!(sample.value, [1.0, 2.0, 3.0], "{name}: what follows are intervals");
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let angles =
            near(sample.wo.z, wo.z) && near(sample.wi.z, wi.z) && near(sample.wo.dot(sample.wi), wo.dot(wi));
        assert!(angles, "{name}: {sample:?}");
        let same = near(sample.wo.dot(wo), 1.0) && near(sample.wi.dot(wi), 1.0);
        assert!(same || !anisotropic, "{name}: {sample:?}");
    }
}

/// Bytes in MERL's format; `change` may spoil a value.
fn merl(value: impl Fn(usize, Vec3<f64>, Vec3<f64>) -> [f64; 3]) -> Vec<u8> {
    let mut planes = [Vec::new(), Vec::new(), Vec::new()];
    for i in 0..90 * 90 * 180_usize {
        // As the format says: half angle by squares, difference angle and azimuth in degrees.
        let theta_h = ((i / 16_200) as f64 + 0.5).powi(2) / 90.0;
        let theta_d = ((i / 180 % 90) as f64 + 0.5).to_radians();
        let phi_d = ((i % 180) as f64 + 0.5).to_radians();
        let (sin, cos) = theta_h.to_radians().sin_cos();
        let turned = |d: Vec3<f64>| Vec3::new(d.x * cos + d.z * sin, d.y, d.z * cos - d.x * sin);
        let wi = turned(Vec3::from_angles(theta_d, phi_d));
        let half = Vec3::new(sin, 0.0, cos);
        let twice = 2.0 * wi.dot(half);
        let wo = Vec3::new(twice * half.x - wi.x, twice * half.y - wi.y, twice * half.z - wi.z);
        let f = value(i, wo, wi);
        for ((plane, f), scale) in planes.iter_mut().zip(f).zip([1500.0, 1500.0 / 1.15, 1500.0 / 1.66]) {
            plane.push(f * scale);
        }
    }
    let header = [90_i32, 90, 180].into_iter().flat_map(i32::to_le_bytes);
    header.chain(planes.into_iter().flatten().flat_map(f64::to_le_bytes)).collect()
}

#[test]
fn merl_binary_is_the_brdf() {
    let lobe = lobe();
    let bytes = merl(|_, wo, wi| lobe.eval(wo, wi));
    let folder = std::env::temp_dir().join(format!("catseye-merl-{}", std::process::id()));
    std::fs::write(&folder, &bytes).unwrap();
    let brdf = Brdf::read(&folder, Cosine::AsStated);
    std::fs::remove_file(&folder).unwrap();
    let brdf = brdf.unwrap();
    assert!(brdf.samples.len() > 900_000 && brdf.skipped.invalid == 0 && brdf.remarks.is_empty());
    assert_is(&brdf, &lobe, [0, 1, 2], 1e-9);
    let nearest = brdf.samples.iter().map(|s| Geometry { wo: s.wo, wi: s.wi }.observation());
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!((nearest.to_degrees() - 1.0).abs() < 1e-6, "difference angles of half a degree: {nearest}");

    // What was not measured is counted, and spoils nothing.
    let spoiled = merl(|i, wo, wi| match i {
        7 => [-1.0, 0.1, 0.1],
        8 => [f64::NAN; 3],
        9 => [0.1, f64::INFINITY, 0.1],
        _ => lobe.eval(wo, wi),
    });
    assert_eq!(Brdf::parse(&spoiled, "a.binary", Cosine::AsStated).unwrap().skipped.invalid, 3);

    for (bytes, problem) in [
        (&bytes[..bytes.len() - 1], "cut off"),
        (&bytes[..12], "cut off"),
        (&[255, 255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 1][..], "65535 x 65535 x 65535"),
    ] {
        let message = Brdf::parse(bytes, "a.binary", Cosine::AsStated).unwrap_err().to_string();
        assert!(message.starts_with("a.binary: ") && message.contains(problem), "{message}");
    }
}

#[test]
fn bad_alta_files_are_errors_that_name_the_line() {
    let rows = "0.3 0.3 0 1\n";
    for (text, problem) in [
        ("", "no usable samples"),
        (rows, "no #PARAM_IN"),
        ("#PARAM_IN CARTESIAN\n1 2 3 4 5 6 7\n", "no #DIM"),
        ("#DIM 4 1\n#PARAM_IN ISOTROPIC_TL_TV_PROJ_DPHI\n0 0 0 0 1\n", "takes 3"),
        ("#DIM 3 1000000000000\n", ":1: #DIM says 1000000000000"),
        ("#DIM -3 1\n", ":1: #DIM needs two numbers"),
        ("#DIM 3 1\n#PARAM_IN STARK_3D\n", ":2: #PARAM_IN STARK_3D is not known; known are ISOTROPIC"),
        ("#PARAM_OUT ENERGY\n", ":1: #PARAM_OUT ENERGY"),
        ("#FORMAT binary\n", "data2data"),
        (&format!("{HEADER}{rows}0.3 0.3\n"), ":7: has 2 numbers where #DIM says 4"),
        (&format!("{HEADER}0.3 0.3 zero 1\n"), ":6: number 3: \"zero\""),
        (
            &format!("{HEADER}0.3 0.3 0 -1\n0.3 NaN 0 1\n0.3 2.5 0 1\n"),
            "2 are negative, not finite or above 1e9/sr, 1 below",
        ),
    ] {
        let message = Brdf::parse(text.as_bytes(), "a.dat", Cosine::AsStated).unwrap_err().to_string();
        assert!(message.starts_with("a.dat:") && message.contains(problem), "{text:?}: {message}");
    }
    let message = Brdf::parse(b"\xff\xfe\x00garbage", "a.dat", Cosine::AsStated).unwrap_err().to_string();
    assert!(message.contains("neither"), "{message}");
}

#[test]
fn a_selection_is_what_a_fit_can_use() {
    let header = format!("{HEADER}#PARAM_OUT INV_STERADIAN\n");
    let brdf = Brdf::parse(alta(&lobe(), &header, false).as_bytes(), "a.dat", Cosine::AsStated).unwrap();
    let selection = Selection { observation: 0.2, zenith: 1.3, floor: 1e-4, count: 40 };
    let chosen = selection.of(&brdf);
    let observation =
        |s: &catseye_photometry::brdf::BrdfSample| Geometry { wo: s.wo, wi: s.wi }.observation();
    assert!((20..=40).contains(&chosen.len()), "{}", chosen.len());
    assert!(chosen.windows(2).all(|pair| observation(pair[0]) <= observation(pair[1])));
    assert!(chosen.iter().all(|s| observation(s) <= 0.2 && s.wo.z.min(s.wi.z) >= 1.3_f64.cos()));

    let apertures = Apertures::both_deg(1.0).rule().unwrap();
    let rows = selection.observations(&brdf, &apertures);
    assert_eq!(rows.len(), chosen.len());
    for (row, sample) in rows.iter().zip(chosen) {
        let mean: f64 = row.views.iter().map(|v| v.factor * lobe().eval(v.wo, v.wi)[1]).sum();
        let expected = apertures.mean(sample.wo, sample.wi, |wo, wi| lobe().eval(wo, wi)[1]);
        assert!((mean / expected - 1.0).abs() < 1e-12 && row.value == sample.luminance());
    }
}

#[test]
fn a_lobe_is_found_in_a_grid_that_has_the_retro_direction() {
    let header = format!("{HEADER}#PARAM_OUT INV_STERADIAN\n");
    let params = Params::isotropic(0.08).with_tint([0.5; 3]);
    let text = alta(&Reciprocal::new(&params).unwrap(), &header, false);
    let brdf = Brdf::parse(text.as_bytes(), "a.dat", Cosine::AsStated).unwrap();
    let rows = Selection::default().observations(&brdf, &Apertures::both_deg(0.0).rule().unwrap());
    assert!(rows.iter().any(|row| row.views[0].wo == row.views[0].wi));
    let options =
        FitOptions { lobes: Some(1), entrance: Some(EntranceKind::Constant), ..FitOptions::default() };
    let found = fit(&rows, &options).unwrap().sheeting.lobes[0];
    // The data are those of such a lobe, exactly.
    assert!((found.roughness[0] / 0.08 - 1.0).abs() < 1e-4, "{found:?}");
    assert!((found.strength / 0.5 - 1.0).abs() < 1e-4, "{found:?}");
}

/// Uniform numbers in [-1, 1), by Knuth's linear congruence.
fn noise(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A tape as the published ones are: two lobes on a base under a coat.
fn tape() -> Sheeting {
    let law = Some(EntranceLaw::power(3.0));
    let lobe = |strength, roughness| RetroLobe { strength, roughness: [roughness; 2], entrance: law };
    let lobes = vec![lobe(0.1, 0.02), lobe(0.12, 0.07)];
    let coat_ior = Some(1.5);
    Sheeting { lobes, diffuse: 0.2, coat_ior, coat_roughness: 0.05, ..Sheeting::default() }
}

/// Its file: light at 15, 30 and 60 degrees, rings of a degree around the retro direction, which is a sample
/// itself up to rounding, and around the mirror direction, a grid of 5 degrees, and noise of 10 % in the
/// mean.
fn text_of(tape: &Sheeting) -> String {
    let (prepared, mut state) = (tape.prepare().unwrap(), 1);
    let mut text = format!("{HEADER}#PARAM_OUT INV_STERADIAN\n");
    for light in [15.0_f64, 30.0, 60.0].map(f64::to_radians) {
        let rings = (0..20).flat_map(|ring| (0..24).map(move |spoke| (f64::from(ring), f64::from(spoke))));
        let around = rings.filter(|(ring, spoke)| *ring > 0.0 || *spoke == 0.0).flat_map(|(ring, spoke)| {
            let (sin, cos) = (15.0 * spoke).to_radians().sin_cos();
            let offset = ring.to_radians();
            [light, -light].map(|middle| [middle + offset * cos, offset * sin])
        });
        let grid =
            (-16..=16).flat_map(|i| (-16..=16).map(move |j| [i, j].map(|k| f64::from(5 * k).to_radians())));
        for [x, y] in around.chain(grid) {
            let (wo, wi) = (Vec3::from_angles(x.hypot(y), y.atan2(x)), Vec3::from_angles(light, 0.0));
            if wo.z > 0.1 {
                let f = prepared.eval_with_surface(wo, wi) * (0.1 * 3_f64.sqrt() * noise(&mut state)).exp();
                text += &format!("{light:.17} {x:.17} {y:.17} {f:.17e}\n");
            }
        }
    }
    text
}

fn brdf_of(tape: &Sheeting) -> Brdf {
    Brdf::parse(text_of(tape).as_bytes(), "tape.dat", Cosine::AsStated).unwrap()
}

fn options() -> FitOptions {
    FitOptions { isotropic: true, diffuse: true, tolerance: 0.4, of_rms: true, ..FitOptions::default() }
}

#[test]
fn lobes_base_and_coat_are_found_where_they_are_measured() {
    let brdf = brdf_of(&tape());
    let selection = Selection { count: 400, ..Selection::default() };
    let found = brdf.fit(&selection, Apertures::both_deg(0.0), &options()).unwrap();
    let sheeting = &found.fit.sheeting;
    // 10 % of noise over some hundred samples each.
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.03;
    assert!(near(sheeting.coat_ior.unwrap(), 1.5) && near(sheeting.coat_roughness, 0.05), "{sheeting:?}");
    assert!(near(sheeting.diffuse, 0.2), "{sheeting:?}");
    let mut widths: Vec<f64> = sheeting.lobes.iter().map(|lobe| lobe.roughness[0]).collect();
    widths.sort_by(f64::total_cmp);
    assert!(near(widths[0], 0.02) && near(widths[1], 0.07), "{sheeting:?}");
    assert!(found.fit.acceptable && found.parts.len() == 4, "{:?}", found.parts);
    for part in &found.parts {
        assert!(part.metrics.log_rmse < 0.11 && part.metrics.outliers(0.4) == 0, "{part:?}");
    }
    assert_eq!(found.parts[3].metrics.count, brdf.samples.len());
    assert!(
        !found.fit.warnings.iter().any(|warning| warning.contains("not met")),
        "{:?}",
        found.fit.warnings
    );

    // Whoever wants another index is told that the peak is not that one's.
    let other = FitOptions { coat_ior: Some(3.5), ..options() };
    let found = brdf.fit(&selection, Apertures::both_deg(0.0), &other).unwrap();
    assert_eq!(found.fit.sheeting.coat_ior, Some(3.5));
    let said =
        |warning: &String| warning.starts_with("the mirror peak is not met: within 20 deg of the mirror");
    assert!(found.fit.warnings.iter().any(said), "{:?}", found.fit.warnings);
}

#[test]
fn a_tape_without_a_mirror_peak_has_no_coat_and_a_diffuse_surface_no_fit() {
    let selection = Selection { count: 400, ..Selection::default() };
    let fit = |tape: &Sheeting| brdf_of(tape).fit(&selection, Apertures::both_deg(0.0), &options());
    let dull = fit(&Sheeting { coat_ior: None, ..tape() }).unwrap().fit;
    assert!(dull.acceptable && dull.form.coat_ior.is_none() && dull.sheeting.coat_roughness == 0.0);
    let error = fit(&Sheeting { coat_ior: None, lobes: Vec::new(), ..tape() }).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no lobe stands out of the values near the retro direction: they are those of a diffuse surface"
    );
}

/// An aperture that is small beside the lobe changes little, and so does one that is a tenth of a degree
/// wider.
#[test]
fn fits_change_smoothly_with_the_aperture() {
    let brdf = brdf_of(&Sheeting { coat_ior: None, ..tape() });
    let selection = Selection { count: 300, ..Selection::default() };
    let mut before: Option<f64> = None;
    for tenths in 0..=20 {
        let apertures = Apertures::both_deg(0.1 * f64::from(tenths)).rule_of_degree(7).unwrap();
        let rows = selection.observations(&brdf, &apertures);
        let options = FitOptions { lobes: Some(2), entrance: Some(EntranceKind::Power), ..options() };
        let found = fit(&rows, &options).unwrap();
        // The noise, and at 2 degrees what a blurred model makes of data that are not.
        assert!(found.acceptable && found.rms < 0.105, "{tenths}: {}", found.rms);
        assert!(found.sheeting.lobes.iter().all(|lobe| lobe.strength > 0.01), "{tenths}: {found:?}");
        if let Some(before) = before {
            assert!((found.rms - before).abs() < 1e-3, "{tenths}: {before} and {}", found.rms);
        }
        before = Some(found.rms);
    }
}

#[test]
fn metrics_are_what_they_say() {
    assert!(metrics([]).is_none() && metrics([(1.0, 2.0), (3.0, 2.0)]).is_none());
    let same = metrics([(1.0, 1.0), (5.0, 5.0)]).unwrap();
    assert_eq!((same.nrmse, same.log_rmse, same.count), (0.0, 0.0, 2));
    let off = metrics([(1.1, 1.0), (11.0, 10.0), (f64::NAN, 3.0)]).unwrap();
    assert!((off.log_rmse - 1.1_f64.ln()).abs() < 1e-12 && off.count == 2);
    assert!((off.nrmse - (0.505_f64).sqrt() / 9.0).abs() < 1e-12, "{off:?}");
    assert!((off.percentile_95() - 0.1).abs() < 1e-12 && (off.worst() - 0.1).abs() < 1e-12);
}

/// Root mean square, 95 % and outliers each refuse on their own.
#[test]
fn errors_are_accepted_up_to_those_of_a_normal_distribution() {
    // So many values off by so many times the tolerance; alternating values, so that there is a range.
    let judged = |groups: &[(usize, f64)]| {
        let errors = groups.iter().flat_map(|&(count, error)| std::iter::repeat_n(error, count));
        let pairs = errors.enumerate().map(|(i, error)| {
            let value = 1.0 + (i % 2) as f64;
            (value * (0.4 * error).exp(), value)
        });
        metrics(pairs).unwrap()
    };
    assert!(judged(&[(950, 0.9), (48, -1.9), (2, 3.9)]).is_within(0.4));
    assert!(!judged(&[(1000, 1.01)]).is_within(0.4));
    assert!(!judged(&[(940, 0.1), (60, 2.1)]).is_within(0.4));
    let faults = |count| judged(&[(1000 - count, 0.1), (count, -4.8)]);
    assert!(faults(5).is_within(0.4) && !faults(6).is_within(0.4));
    assert_eq!(faults(5).outliers(0.4), 5);
    // A value that is 586 % off is an outlier of the default tolerance.
    assert!(Metrics::outlying(0.4) < 5.86);
}
