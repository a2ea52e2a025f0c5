//! What the driver sees agrees with an independent computation.

use catseye_photometry::Geometry;
use catseye_photometry::drive::{DriveError, Road, Scene, Sight, Sign, Vehicle};
use catseye_photometry::lamp::Lamp;

/// Computed once with numpy 2.4.6 from the definitions of CIE ILV and ASTM E808, by someone else than the author
/// of the code: x ahead, y left, z up, lamps at y = +-half the spacing, a straight level road, 10 000 cd in every
/// direction, and sheeting of R_A = 400 exp(-alpha / 0.425) exp(-beta^2 / 2220), in degrees.
///
/// Vehicle, sign, distance, lamp; H, V in degrees and the distance; alpha, beta, nu; epsilon, omega, gamma, `beta_1`,
/// `beta_2`; E in lx, `R_A`, L in cd/m2.
const VECTORS: &str = "\
    car shoulder 50 L 6.91054 2.13768 50.40097 0.768422 7.232087 6.621179 37.5153 -107.2355 35.4651 5.90084 -4.18871 3.9366080 64.06209 253.880654
    car shoulder 50 R 5.64251 2.14288 50.27860 1.009712 6.034486 6.621179 -52.7038 -110.8352 121.7260 -3.18180 -5.13013 3.9557932 36.57149 145.640641
    car shoulder 100 L 3.46788 1.07506 100.20109 0.344233 3.630504 3.380277 31.3463 -107.2355 41.4753 2.72172 -2.40357 0.9959903 176.89705 176.494822
    car shoulder 100 R 2.82811 1.07572 100.13959 0.546949 3.025634 3.380277 -57.4626 -110.8352 126.5891 -1.80458 -2.42897 0.9972140 109.99137 109.876095
    car shoulder 150 L 2.31349 0.71748 150.13413 0.220665 2.422137 2.268327 28.8804 -107.2355 43.9096 1.74549 -1.67955 0.4436506 237.36740 105.390780
    car shoulder 150 R 1.88626 0.71768 150.09310 0.374496 2.018131 2.268327 -58.9310 -110.8352 128.0786 -1.24498 -1.58848 0.4438933 165.41602 73.484636
    car shoulder 200 L 1.73553 0.53832 200.10062 0.162234 1.817076 1.706691 27.5581 -107.2355 45.2208 1.28012 -1.28970 0.2497486 272.66688 68.128406
    car shoulder 200 R 1.41492 0.53840 200.06983 0.284628 1.513872 1.706691 -59.6438 -110.8352 128.7989 -0.94871 -1.17978 0.2498255 204.53098 51.119733
    car shoulder 300 L 1.15722 0.35898 300.06709 0.106006 1.211610 1.141373 26.1724 -107.2355 46.5985 0.83257 -0.88027 0.1110614 311.49299 34.601723
    car shoulder 300 R 0.94339 0.35900 300.04656 0.192279 1.009379 1.141373 -60.3427 -110.8352 129.5031 -0.64213 -0.77881 0.1110766 254.31792 28.254384
    car overhead 50 L 0.64169 6.70676 50.34767 0.807097 6.737248 5.952901 18.1602 -174.5597 -12.8054 6.57117 1.48997 3.9449475 58.67229 232.714016
    car overhead 50 R -0.64169 6.70676 50.34767 1.277886 6.737248 5.952901 -52.9704 174.5597 47.7277 4.54330 -4.98006 3.9449475 19.37973 76.866533
    car overhead 100 L 0.32085 3.36506 100.17429 0.356419 3.380309 3.037178 20.2723 -174.5597 -14.8566 3.26756 0.86625 0.9965233 172.03261 171.675654
    car overhead 100 R -0.32085 3.36506 100.17429 0.615682 3.380309 3.037178 -57.0731 174.5597 51.6813 2.09741 -2.65151 0.9965233 93.47118 93.277232
    car overhead 150 L 0.21390 2.24483 150.11625 0.226536 2.254992 2.037840 21.1372 -174.5597 -15.7084 2.17086 0.61037 0.4437564 234.19385 103.990781
    car overhead 150 R -0.21390 2.24483 150.11625 0.405205 2.254992 2.037840 -58.5549 174.5597 53.1358 1.35326 -1.80396 0.4437564 153.81494 68.299553
    car overhead 200 L 0.16043 1.68400 200.08720 0.165673 1.691626 1.533205 21.6076 -174.5597 -16.1739 1.62471 0.47115 0.2497821 270.52285 67.595978
    car overhead 200 R -0.16043 1.68400 200.08720 0.301937 1.691626 1.533205 -59.3181 174.5597 53.8897 0.99714 -1.36657 0.2497821 196.31774 49.054228
    car overhead 300 L 0.10695 1.12285 300.05814 0.107599 1.127933 1.025320 22.1062 -174.5597 -16.6689 1.08055 0.32352 0.1110681 310.35523 34.476073
    car overhead 300 R -0.10695 1.12285 300.05814 0.199985 1.127933 1.025320 -60.0965 174.5597 54.6614 0.65246 -0.92009 0.1110681 249.71980 27.740334
    suv shoulder 100 L 3.51926 0.95495 100.20285 0.413563 3.646362 3.352120 32.5501 -105.1920 42.3157 2.69794 -2.45388 0.9959553 150.26288 149.911602
    suv shoulder 100 R 2.77667 0.95563 100.13147 0.626639 2.936393 3.352120 -56.1749 -109.0001 127.1386 -1.77382 -2.34045 0.9973758 91.20736 91.123925
    suv overhead 100 L 0.37242 3.24513 100.16272 0.424199 3.266405 2.861540 22.7338 -173.4602 -16.2190 3.13667 0.91188 0.9967534 146.72252 146.428757
    suv overhead 100 R -0.37242 3.24513 100.16272 0.699270 3.266405 2.861540 -55.9466 173.4602 49.4529 2.12473 -2.48148 0.9967534 76.80869 76.654904
    truck shoulder 100 L 3.66194 0.86905 100.21612 0.815179 3.763508 3.405779 18.4419 -103.3602 58.2532 1.98229 -3.19978 0.9956916 58.38249 58.233807
    truck shoulder 100 R 2.63375 0.86991 100.11728 1.092455 2.773598 3.405779 -44.9158 -108.2854 116.6035 -1.24283 -2.47975 0.9976585 30.49363 30.476055
    truck overhead 100 L 0.51565 3.15939 100.15628 0.837077 3.201154 2.368293 14.1982 -170.7398 -4.9457 3.18926 0.27583 0.9968817 55.54851 55.422631
    truck overhead 100 R -0.51565 3.15939 100.15628 1.156857 3.201154 2.368293 -45.4226 170.7398 36.2051 2.58397 -1.89021 0.9968817 26.17571 26.116395
";

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

/// Avery Dennison, "Learn sheeting", chapter 8: a sign 6 m above the road, a sedan's left lamp. 500 m: observation
/// 0.06, entrance 0.6, rotation 22 degrees; 170 m: observation 0.2; 70 to 80 m: entrance 4, observation 0.5,
/// rotation 19. Their car's sizes are not given, so the digits that they print are what can be compared.
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

/// Turning the sign is turning the world the other way: the normal and the datum axis stay orthonormal, and the
/// entrance angle is that to the tilted normal.
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
