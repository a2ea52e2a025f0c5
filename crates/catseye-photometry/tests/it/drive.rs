//! What the driver sees agrees with an independent computation.

use catseye_photometry::Geometry;
use catseye_photometry::drive::{DriveError, Road, Scene, Sight, Sign, Vehicle};
use catseye_photometry::lamp::Lamp;

/// Computed once with numpy 2.4.6 from the definitions of CIE ILV and ASTM E808, by someone else than the
/// author of the code: x ahead, y left, z up, lamps at y = +-half the spacing, a straight level road, 10 000
/// cd in every direction, and sheeting of R_A = 400 exp(-alpha / 0.425) exp(-beta^2 / 2220), in degrees.
///
/// Vehicle, sign, distance, lamp; H, V in degrees and the distance; alpha, beta, nu; epsilon, omega, gamma,
/// `beta_1`, `beta_2`; E in lx, `R_A`, L in cd/m2.
const VECTORS: &str = include_str!("drive_vectors.txt");

/// The vehicles of the vectors.
fn vehicle(name: &str) -> Vehicle {
    let of = |lamp_height_m, lamp_spacing_m, [eye_left_m, eye_height_m, eye_behind_m]: [f64; 3]| Vehicle {
        lamp_height_m,
        lamp_spacing_m,
        eye_height_m,
        eye_left_m,
        eye_behind_m,
    };
    match name {
        "car" => of(0.62, 1.12, [0.35, 1.11, 1.8]),
        "suv" => of(0.83, 1.30, [0.37, 1.42, 1.9]),
        _ => of(0.98, 1.80, [0.55, 2.33, 1.7]),
    }
}

fn r_a(geometry: &Geometry) -> f64 {
    let (alpha, beta) = (geometry.observation().to_degrees(), geometry.entrance().to_degrees());
    400.0 * (-alpha / 0.425).exp() * (-beta * beta / 2220.0).exp()
}

/// What lamps of 10 000 cd show of that sheeting.
fn sight(scene: Scene, distance_m: f64) -> (Sight, [f64; 2]) {
    let sight = scene.sight(distance_m, &Lamp::even(1e4)).unwrap();
    (sight, sight.luminances(sight.view.lamps.map(|lamp| r_a(&lamp.geometry))))
}

fn scene(vehicle: Vehicle, sign: Sign) -> Scene {
    Scene { vehicle, road: Road::Straight, sign }
}

#[test]
fn vectors_are_met() {
    assert_eq!(VECTORS.lines().count(), 28);
    for line in VECTORS.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let sign = if words[1] == "shoulder" { Sign::SHOULDER } else { Sign::OVERHEAD };
        let distance = words[2].parse().unwrap();
        let number = usize::from(words[3] == "R");
        let (sight, luminances) = sight(scene(vehicle(words[0]), sign), distance);
        let view = sight.view.lamps[number];
        let (goniometer, intrinsic) = (view.goniometer(), view.intrinsic());
        let found = [
            view.right_deg,
            view.up_deg,
            view.distance_m,
            goniometer.observation.to_degrees(),
            intrinsic.entrance.to_degrees(),
            view.geometry.viewing().to_degrees(),
            goniometer.rotation.to_degrees(),
            intrinsic.orientation.to_degrees(),
            intrinsic.presentation.to_degrees(),
            goniometer.entrance_1.to_degrees(),
            goniometer.entrance_2.to_degrees(),
            sight.light[number].illuminance_lx,
            r_a(&view.geometry),
            luminances[number],
        ];
        for (i, (found, word)) in found.into_iter().zip(&words[4..]).enumerate() {
            let mut expected: f64 = word.parse().unwrap();
            // The vectors count the orientation from the source, this crate from the normal's side (E808's
            // entrance half-plane): half a turn.
            if i == 7 {
                expected -= 180.0 * expected.signum();
            }
            // Half a unit of the last digit that is printed, and 1e-6 of rounding in them.
            let digits = word.split_once('.').map_or(0, |(_, digits)| digits.len());
            let tolerance = 0.51 * 0.1_f64.powi(digits as i32) + 1e-6 * found.abs().min(1.0);
            assert!((found - expected).abs() <= tolerance, "{line}: number {i} is {found}");
        }
    }
}

/// In the printed digits of the sums: car, both lamps.
#[test]
fn luminance_is_the_sum_of_both_lamps() {
    for (sign, distance, expected) in [
        (Sign::SHOULDER, 50.0, 399.521295),
        (Sign::SHOULDER, 300.0, 62.856107),
        (Sign::OVERHEAD, 100.0, 264.952885),
    ] {
        let [left, right] = sight(scene(Vehicle::CAR, sign), distance).1;
        assert!((left + right - expected).abs() < 1e-6, "{distance}: {left} {right}");
    }
}

/// Avery Dennison, "Learn sheeting", chapter 8: a sign 6 m above the road, a sedan's left lamp. 500 m:
/// observation 0.06, entrance 0.6, rotation 22 degrees; 170 m: observation 0.2; 70 to 80 m: entrance 4,
/// observation 0.5, rotation 19. Their car's sizes are not given, so the digits that they print are what can
/// be compared.
#[test]
fn the_published_walk_through_is_found() {
    let sign = Sign { height_m: 6.0, ..Sign::OVERHEAD };
    let angles = |distance| {
        let view = scene(Vehicle::CAR, sign).view(distance).unwrap().lamps[0];
        let (angles, entrance) = (view.goniometer(), view.geometry.entrance());
        [angles.observation, entrance, angles.rotation].map(f64::to_degrees)
    };
    let near =
        |found: f64, expected: f64, tolerance| assert!((found - expected).abs() < tolerance, "{found}");
    let [observation, entrance, rotation] = angles(500.0);
    near(observation, 0.06, 0.005);
    near(entrance, 0.6, 0.05);
    near(rotation, 22.0, 1.0);
    near(angles(170.0)[0], 0.2, 0.005);
    let [observation, entrance, rotation] = angles(75.0);
    near(observation, 0.5, 0.02);
    near(entrance, 4.0, 0.15);
    near(rotation, 19.0, 1.0);
}

/// A wide curve or a shallow dip is a straight road, and both move the sign by d^2 / 2R at first.
#[test]
fn curves_and_dips_become_straight() {
    let at = |road, distance| {
        let scene = Scene { vehicle: Vehicle::CAR, road, sign: Sign::SHOULDER };
        scene.view(distance).unwrap().sign
    };
    let straight = at(Road::Straight, 100.0);
    let roads: [fn(f64) -> Road; 2] =
        [|radius_m| Road::Curve { radius_m }, |radius_m| Road::Dip { radius_m }];
    for (number, road) in roads.into_iter().enumerate() {
        for radius in [1e6, -1e6] {
            let step = at(road(radius), 100.0) - straight;
            let sideways = [step.y, step.z][number];
            assert!((sideways - 1e4 / (2.0 * radius)).abs() < 1e-6, "{number} {radius}: {step:?}");
            assert!(step.dot(step).sqrt() < 6e-3);
        }
    }
    // A quarter of the circle to the left: the sign on the right is beyond its centre line.
    let quarter = at(Road::Curve { radius_m: 100.0 }, 50.0 * std::f64::consts::PI - 60.0);
    assert!(quarter.x > 0.0 && quarter.y > 20.0, "{quarter:?}");
}

/// Behind a crest of 500 m a sign of 2.5 m is seen as far as the two sight distances to the horizon:
/// sqrt(2 R h) each, in the limit of small angles.
#[test]
fn a_crest_hides_what_is_behind_it() {
    let sign = Sign { right_m: 0.0, ..Sign::SHOULDER };
    let scene = Scene { vehicle: Vehicle::CAR, road: Road::Dip { radius_m: -500.0 }, sign };
    let horizon = |height: f64| (2.0 * 500.0 * height).sqrt();
    let of_lamp = horizon(0.62) + horizon(2.5);
    assert!(sight(scene, of_lamp - 2.0).1.iter().all(|luminance| *luminance > 0.0));
    let (far, luminances) = sight(scene, of_lamp + 2.0);
    assert!(far.light.iter().all(|light| light.illuminance_lx == 0.0) && luminances == [0.0; 2]);
    assert!(!far.view.is_hidden, "the eye is higher than the lamps");
    let of_eye = horizon(1.11) + horizon(2.5);
    assert!(scene.view(of_eye + 3.0).unwrap().is_hidden);
    // A dip hides nothing.
    let dip = Scene { road: Road::Dip { radius_m: 500.0 }, ..scene };
    assert!(!dip.view(of_eye + 3.0).unwrap().is_hidden);
}

/// Turning the sign is turning the world the other way: the normal and the datum axis stay orthonormal, and
/// the entrance angle is that to the tilted normal.
#[test]
fn tilt_yaw_and_turn_move_the_axes() {
    let sign = Sign { tilt_deg: 10.0, yaw_deg: 20.0, turn_deg: 30.0, right_m: 0.0, height_m: 0.62 };
    let view = scene(Vehicle::CAR, sign).view(1e4).unwrap();
    let (normal, datum) = (view.normal, view.datum);
    assert!((normal.dot(normal) - 1.0).abs() < 1e-14 && (datum.dot(datum) - 1.0).abs() < 1e-14);
    assert!(normal.dot(datum).abs() < 1e-15);
    assert!(normal.x < 0.0 && normal.y > 0.0 && normal.z > 0.0, "to the left and up: {normal:?}");
    let expected = (10.0_f64.to_radians().cos() * 20.0_f64.to_radians().cos()).acos();
    assert!((view.lamps[0].geometry.entrance() - expected).abs() < 1e-4);
    // Counter-clockwise from the front: 12 o'clock goes to the driver's left.
    let turned = Sign { turn_deg: 90.0, ..Sign::OVERHEAD };
    let datum = scene(Vehicle::CAR, turned).view(50.0).unwrap().datum;
    assert!((datum.y - 1.0).abs() < 1e-15, "{datum:?}");
    let rotation = |turn_deg| {
        let view = scene(Vehicle::CAR, Sign { turn_deg, ..Sign::SHOULDER }).view(50.0).unwrap();
        view.lamps[0].goniometer().rotation.to_degrees()
    };
    assert!((rotation(15.0) - rotation(0.0) - 15.0).abs() < 1e-9, "{} {}", rotation(15.0), rotation(0.0));
}

#[test]
fn what_can_t_be_seen_is_refused() {
    let message = |scene: Scene, distance| scene.view(distance).unwrap_err().to_string();
    let plain = scene(Vehicle::CAR, Sign::SHOULDER);
    for distance in [0.0, -20.0, f64::NAN, 1e9] {
        assert!(message(plain, distance).contains("outside (0, 100000] m"));
    }
    let bent = Scene { road: Road::Curve { radius_m: 20.0 }, ..plain };
    assert!(message(bent, 50.0).contains("turn before the sign is 143.239, outside (-90, 90) degrees"));
    let cab = scene(Vehicle { eye_behind_m: -2.0, ..Vehicle::TRUCK }, Sign::OVERHEAD);
    let behind = "at a distance of 1 m the sign is 1 m ahead of the headlamps, not in front of lamps and eye";
    assert!(message(cab, 1.0).starts_with(behind), "{}", message(cab, 1.0));
    let turned = scene(Vehicle::CAR, Sign { yaw_deg: 90.0, ..Sign::OVERHEAD });
    assert!(message(turned, 50.0).contains("back or its edge to the"), "{}", message(turned, 50.0));
    let low = Vehicle { lamp_height_m: 0.0, ..Vehicle::CAR };
    assert!(matches!(scene(low, Sign::SHOULDER).view(50.0), Err(DriveError::Range { .. })));
    let tight = Scene { road: Road::Dip { radius_m: 0.0 }, ..plain };
    assert!(message(tight, 50.0).contains("5 m and above"));
}
