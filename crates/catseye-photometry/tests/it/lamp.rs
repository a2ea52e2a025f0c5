//! Files of lamps say the same in every format, and broken ones say what is wrong with them.

use catseye_photometry::Error;
use catseye_photometry::lamp::{Axis, Lamp};

/// A direction: to the right, up and ahead.
type Direction = [f64; 3];

/// A beam whose middle lies below and to the right; nothing about it is symmetric.
fn skewed([right, up, ahead]: Direction) -> f64 {
    let [x, y, z] = [0.2, -0.1, (1.0_f64 - 0.05).sqrt()];
    1000.0 * (4.0 * (x * right + y * up + z * ahead - 1.0)).exp() + 20.0 * (1.0 + right)
}

fn of_type_a(right_deg: f64, up_deg: f64) -> Direction {
    let (sin_h, cos_h) = right_deg.to_radians().sin_cos();
    let (sin_v, cos_v) = up_deg.to_radians().sin_cos();
    [cos_v * sin_h, sin_v, cos_v * cos_h]
}

/// The polar axis is horizontal and to the right.
fn of_type_b(plane_deg: f64, tipped_deg: f64) -> Direction {
    let (sin_h, cos_h) = plane_deg.to_radians().sin_cos();
    let (sin_v, cos_v) = tipped_deg.to_radians().sin_cos();
    [sin_h, cos_h * sin_v, cos_h * cos_v]
}

/// Gamma from straight ahead, C0 to the right, C90 up.
fn of_c_ahead(c_deg: f64, gamma_deg: f64) -> Direction {
    let (sin_c, cos_c) = c_deg.to_radians().sin_cos();
    let (sin_g, cos_g) = gamma_deg.to_radians().sin_cos();
    [sin_g * cos_c, sin_g * sin_c, cos_g]
}

/// Gamma from straight down, C0 ahead, C90 to the left.
fn of_c_down(c_deg: f64, gamma_deg: f64) -> Direction {
    let (sin_c, cos_c) = c_deg.to_radians().sin_cos();
    let (sin_g, cos_g) = gamma_deg.to_radians().sin_cos();
    [-sin_g * sin_c, -cos_g, sin_g * cos_c]
}

fn steps(from: f64, to: f64, step: f64) -> Vec<f64> {
    (0..=((to - from) / step).round() as i32).map(|i| from + f64::from(i) * step).collect()
}

fn joined(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(|number| number.to_string()).collect::<Vec<_>>().join(" ")
}

/// An LM-63 file of a function of horizontal and vertical angle.
fn lm63(number: u8, planes: &[f64], angles: &[f64], value: impl Fn(f64, f64) -> f64) -> String {
    let (vertical, horizontal) = (angles.len(), planes.len());
    let header = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE";
    let mut text = format!("{header}\n1 -1 1 {vertical} {horizontal} {number} 2 0.1 0.1 0\n1 1 50\n");
    text += &format!("{}\n{}\n", joined(angles.iter().copied()), joined(planes.iter().copied()));
    for &plane in planes {
        text += &format!("{}\n", joined(angles.iter().map(|&angle| value(plane, angle))));
    }
    text
}

/// An EULUMDAT file; `run` are the planes whose intensities it has.
fn eulumdat(symmetry: u8, planes: &[f64], run: &[f64], value: impl Fn(f64, f64) -> f64) -> String {
    let gammas = steps(0.0, 180.0, 1.0);
    let mut lines = vec!["maker".to_owned(), "1".to_owned(), symmetry.to_string()];
    lines.extend([planes.len().to_string(), "15".to_owned(), gammas.len().to_string(), "1".to_owned()]);
    lines.extend((8..=12).map(|i| format!("text {i}")));
    lines.extend((13..=23).map(|_| "0".to_owned()));
    lines.extend(["1.0", "0", "1", "1", "H7", "500", "3000 K", "100", "55"].map(str::to_owned));
    lines.extend((0..10).map(|_| "0,5".to_owned()));
    lines.extend(planes.iter().chain(&gammas).map(f64::to_string));
    for &plane in run {
        // In cd per 1000 lm, with decimal commas.
        lines.extend(
            gammas.iter().map(|&gamma| format!("{:.6}", 2.0 * value(plane, gamma)).replace('.', ",")),
        );
    }
    lines.join("\r\n")
}

/// Asserts that a lamp has the intensities of a function, as well as nets of a degree can have them.
#[track_caller]
fn has(lamp: &Lamp, truth: impl Fn(Direction) -> f64) {
    let mut state = 1_u32;
    let mut uniform = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX)
    };
    for _ in 0..2000 {
        let (right, up) = (360.0 * uniform() - 180.0, 178.0 * uniform() - 89.0);
        let Some(found) = lamp.intensity_cd(right, up) else { continue };
        let expected = truth(of_type_a(right, up));
        assert!((found / expected - 1.0).abs() < 2e-3, "{right} right, {up} up: {found}, not {expected}");
    }
    assert!(lamp.intensity_cd(3.0, -2.0).is_some(), "the lamp shines ahead");
}

#[test]
fn every_type_of_lm_63_has_the_same_beam() {
    let (wide, high) = (steps(-90.0, 90.0, 1.0), steps(-90.0, 90.0, 1.0));
    let a = lm63(3, &wide, &high, |h, v| skewed(of_type_a(h, v)));
    has(&Lamp::parse_lm63(a.as_bytes(), "a.ies", None).unwrap(), skewed);
    let b = lm63(2, &wide, &high, |h, v| skewed(of_type_b(h, v)));
    has(&Lamp::parse_lm63(b.as_bytes(), "b.ies", None).unwrap(), skewed);
    let (around, down) = (steps(0.0, 360.0, 1.0), steps(0.0, 180.0, 1.0));
    let c = lm63(1, &around, &down, |c, g| skewed(of_c_ahead(c, g)));
    has(&Lamp::parse_lm63(c.as_bytes(), "c.ies", Some(Axis::Ahead)).unwrap(), skewed);
    let open = lm63(1, &around[..360], &down, |c, g| skewed(of_c_ahead(c, g)));
    has(&Lamp::parse_lm63(open.as_bytes(), "c.ies", Some(Axis::Ahead)).unwrap(), skewed);
    let c = lm63(1, &around, &down, |c, g| skewed(of_c_down(c, g)));
    has(&Lamp::parse_lm63(c.as_bytes(), "c.ies", Some(Axis::Down)).unwrap(), skewed);
}

#[test]
fn halves_and_quarters_become_the_whole() {
    let left_right = |[right, up, ahead]: Direction| skewed([right.abs(), up, ahead]);
    let right_half =
        lm63(3, &steps(0.0, 90.0, 1.0), &steps(-90.0, 90.0, 1.0), |h, v| skewed(of_type_a(h, v)));
    has(&Lamp::parse_lm63(right_half.as_bytes(), "a.ies", None).unwrap(), left_right);

    let up_down = |[right, up, ahead]: Direction| skewed([right, up.abs(), ahead]);
    let both = |[right, up, ahead]: Direction| skewed([right.abs(), up.abs(), ahead]);
    let around = |[right, up, ahead]: Direction| skewed([right.hypot(up), 0.0, ahead]);
    let of = |c: f64, g: f64| skewed(of_c_ahead(c, g));
    let down = steps(0.0, 180.0, 1.0);
    let lm63_of = |last: f64| lm63(1, &steps(0.0, last, 1.0), &down, of);
    let ldt_planes = steps(0.0, 359.0, 1.0);
    let mirrored: Vec<f64> = (270..360).chain(0..=90).map(f64::from).collect();
    let ldt_of = |symmetry: u8, run: &[f64]| eulumdat(symmetry, &ldt_planes, run, of);
    type Truth = dyn Fn(Direction) -> f64;
    let files: [(String, &Truth); 8] = [
        (lm63_of(0.0), &around),
        (lm63_of(90.0), &both),
        (lm63_of(180.0), &up_down),
        (ldt_of(0, &ldt_planes), &skewed),
        (ldt_of(1, &[0.0]), &around),
        (ldt_of(2, &steps(0.0, 180.0, 1.0)), &up_down),
        (ldt_of(3, &mirrored), &left_right),
        (ldt_of(4, &steps(0.0, 90.0, 1.0)), &both),
    ];
    for (number, (text, truth)) in files.into_iter().enumerate() {
        let parse = if number < 3 { Lamp::parse_lm63 } else { Lamp::parse_eulumdat };
        has(&parse(text.as_bytes(), "file", Some(Axis::Ahead)).unwrap(), truth);
    }
}

#[test]
fn factors_layout_and_tilt_of_lm_63_are_read() {
    let body = "1 1000 2 2 3 3 2 0 0 0 0.5 1.1 0\n-10 10, -20 0\n20 1 2 3\n4,5 6";
    let at = |header: &str, right: f64, up: f64| {
        let text = format!("{header}\n{body}");
        Lamp::parse_lm63(text.as_bytes(), "x", None).unwrap().intensity_cd(right, up).unwrap()
    };
    // The factor is 2 x 0.5, and once more 1.1 up to 1991.
    assert_eq!(at("IESNA:LM-63-1995\nTILT=NONE", 0.0, 0.0), 3.5);
    assert_eq!(at("IES:LM-63-2019\nTILT = none", 20.0, 10.0), 6.0);
    assert!((at("IESNA91\n[A] b\nTILT=NONE", -20.0, -10.0) - 1.1).abs() < 1e-15);
    assert!((at("a maker's own words\r\nTILT=NONE", -20.0, 0.0) - 1.65).abs() < 1e-15);
    assert_eq!(at("IESNA:LM-63-2002\nTILT=INCLUDE\n1 2 0 90\n1 0.9", 10.0, 0.0), 4.5);
}

#[test]
fn a_lamp_is_aimed_and_made_brighter() {
    let text = lm63(3, &[-20.0, 20.0], &[-10.0, 10.0], |h, _| h + 20.0);
    let lamp = Lamp::parse_lm63(text.as_bytes(), "x", None).unwrap();
    assert_eq!(lamp.intensity_cd(0.0, 0.0), Some(20.0));
    assert_eq!(lamp.clone().aimed(5.0, 0.0).intensity_cd(0.0, 0.0), Some(15.0));
    assert_eq!(lamp.clone().times(3.0).intensity_cd(0.0, 0.0), Some(60.0));
    // Outside the file's angles nothing is known.
    assert_eq!(lamp.intensity_cd(20.5, 0.0), None);
    assert_eq!(lamp.intensity_cd(0.0, -10.5), None);
}

/// The message of a file that is refused.
fn refused(text: &str, is_eulumdat: bool) -> String {
    let parse = if is_eulumdat { Lamp::parse_eulumdat } else { Lamp::parse_lm63 };
    parse(text.as_bytes(), "lamp", None).unwrap_err().to_string()
}

#[test]
fn a_broken_lm_63_file_is_named_with_its_line() {
    let good = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 50\n-10 10\n-20 20\n1 2\n3 4\n";
    assert!(Lamp::parse_lm63(good.as_bytes(), "lamp", None).is_ok());
    let cases = [
        (String::new(), "lamp: is empty"),
        ("no lamp".to_owned(), "lamp: has no line TILT=; is it an LM-63 file (IES)?"),
        (good.replace("NONE", "x.til"), "lamp:2: TILT=\"x.til\" names another file; write TILT=NONE"),
        (good.replace("3 4\n", ""), "lamp:7: the file ends here; an intensity is expected"),
        (good.replace("3 4", "3 x"), "lamp:8: \"x\" is no number; an intensity is expected"),
        (good.replace("3 4", "3 -4"), "lamp:8: an intensity is -4; it must be 0 or above"),
        (
            good.replace("3 4", "3 4 5"),
            "lamp:8: 5 is left over; the numbers of angles don't fit the intensities",
        ),
        (good.replace("-20 20", "20 -20"), "lamp:6: the horizontal angle -20 follows 20; they must rise"),
        (good.replace("-10 10", "-10 95"), "lamp:5: the vertical angle 95 is outside [-90, 90] degrees"),
        (good.replace("2 2 3 2", "2 2 4 2"), "lamp:3: the type is 4, not 1 (C), 2 (B) or 3 (A)"),
        (
            good.replace("2 2 3 2", "1e9 2 3 2"),
            "lamp:3: the number of vertical angles is 1000000000, not 1 to 2000",
        ),
        (good.replace("2 2 3 2", "2 0 3 2"), "lamp:3: the number of horizontal angles is 0, not 1 to 2000"),
        (
            good.replace("2 2 3 2", "2 2 1 2"),
            "lamp: has the angles of a luminaire (C, gamma); say whether gamma is counted from straight ahead \
             (`ahead`) or from straight down (`down`)",
        ),
        (good.replace("3 4", "3 nan"), "lamp:8: \"nan\" is no number; an intensity is expected"),
    ];
    for (text, message) in cases {
        assert_eq!(refused(&text, false), message, "{text}");
    }
    let c = lm63(1, &[0.0, 45.0], &[0.0, 90.0], |_, _| 1.0);
    let error = Lamp::parse_lm63(c.as_bytes(), "lamp", Some(Axis::Ahead)).unwrap_err().to_string();
    assert!(error.contains("are 0 to 45, not 0 to 0, 90, 180 or 360"), "{error}");
    let large = vec![b' '; 9 << 20];
    assert!(matches!(Lamp::parse_lm63(&large, "lamp", None), Err(Error::Table { .. })));
}

#[test]
fn a_broken_eulumdat_file_is_named_with_its_line() {
    let good = eulumdat(4, &steps(0.0, 345.0, 15.0), &steps(0.0, 90.0, 15.0), |_, _| 100.0);
    let change = |line: usize, text: &str| {
        let mut lines: Vec<&str> = good.split("\r\n").collect();
        lines[line - 1] = text;
        lines.join("\n")
    };
    let cases = [
        (change(3, "7"), "lamp:3: the symmetry is 7, not 0 to 4"),
        (change(4, "0"), "lamp:4: the number of C planes (line 4) is 0, not 1 to 2000"),
        (change(6, "many"), "lamp:6: \"many\" is no number; the number of gamma angles (line 6) is expected"),
        (change(25, "5"), "lamp:25: the lamp was measured tilted; give a file without tilt"),
        (change(26, "2"), "lamp:26: several sets of lamps; keep the one that is used"),
        (change(50, "10"), "lamp:66: the C plane 10 follows 90; they must rise"),
        (
            good.replace("\r\n", "\n").lines().take(20).collect::<Vec<_>>().join("\n"),
            "lamp:20: the file ends here",
        ),
    ];
    for (text, message) in cases {
        let found = refused(&text, true);
        assert!(found.starts_with(message), "{found}");
    }
    let shifted = eulumdat(2, &steps(5.0, 350.0, 15.0), &steps(5.0, 180.0, 15.0), |_, _| 1.0);
    let error = Lamp::parse_eulumdat(shifted.as_bytes(), "lamp", Some(Axis::Down)).unwrap_err().to_string();
    assert_eq!(error, "lamp:4: the C planes don't fit the symmetry (line 3)");
}

/// Cut anywhere, or with any byte of it changed, a file is read or refused in one line.
#[test]
fn truncated_and_damaged_files_are_read_or_refused() {
    let files = [
        lm63(3, &[-20.0, 0.0, 20.0], &[-10.0, 10.0], |h, v| 50.0 + h + v),
        eulumdat(3, &[0.0, 90.0, 180.0, 270.0], &[270.0, 0.0, 90.0], |c, g| c + g),
    ];
    let mut read = 0;
    for (number, file) in files.iter().enumerate() {
        let parse = if number == 0 { Lamp::parse_lm63 } else { Lamp::parse_eulumdat };
        let bytes = file.as_bytes();
        let step = 1 + bytes.len() / 400;
        let cut = (0..bytes.len()).step_by(step).map(|i| bytes[..i].to_vec());
        let damaged = (0..bytes.len()).step_by(step).flat_map(|i| {
            [0, b' ', b'-', b'9', 0xff].map(|byte| {
                let mut bytes = bytes.to_vec();
                bytes[i] = byte;
                bytes
            })
        });
        for bytes in cut.chain(damaged) {
            match parse(&bytes, "lamp", Some(Axis::Ahead)) {
                Err(error) => assert!(!error.to_string().contains(char::is_control), "{error}"),
                Ok(lamp) => {
                    read += 1;
                    let known = lamp.intensity_cd(3.0, 2.0).unwrap_or_default();
                    assert!(known >= 0.0 && known.is_finite(), "{known}");
                }
            }
        }
    }
    assert!(read > 100, "{read} were read");
}
