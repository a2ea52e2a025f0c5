//! The angular systems mean the same directions, to the last digits also where angles are tenths of a degree.

use std::f64::consts::{FRAC_PI_2, PI};

use catseye::Vec3;
use catseye_photometry::{Geometry, Goniometer, Intrinsic, RoadMarking};
use proptest::prelude::*;

/// Directions are rounded to 1e-16, which is 1e-13 of the chord of a tenth of a degree.
const ROUND_TRIP: f64 = 1e-12;

/// The difference of two angles, without whole turns.
fn apart(a: f64, b: f64) -> f64 {
    let turns = (a - b) / (2.0 * PI);
    ((turns - turns.round()) * 2.0 * PI).abs()
}

fn assert_near(name: &str, a: f64, b: f64) {
    assert!(apart(a, b) < ROUND_TRIP, "{name}: {a} became {b}");
}

proptest! {
    #[test]
    fn goniometer_angles_come_back(
        observation in 0.1_f64..120.0, entrance_1 in -179.0_f64..179.0,
        entrance_2 in -85.0_f64..85.0, rotation in -179.0_f64..180.0,
    ) {
        let given = Goniometer::from_degrees(observation, entrance_1, entrance_2, rotation);
        let back = Goniometer::from(Geometry::from(given));
        assert_near("observation", given.observation, back.observation);
        assert_near("entrance_1", given.entrance_1, back.entrance_1);
        assert_near("entrance_2", given.entrance_2, back.entrance_2);
        assert_near("rotation", given.rotation, back.rotation);
    }

    #[test]
    fn intrinsic_angles_come_back(
        observation in 0.1_f64..120.0, entrance in 0.5_f64..179.0,
        presentation in -179.0_f64..180.0, orientation in -179.0_f64..180.0,
    ) {
        let given = Intrinsic::from_degrees(observation, entrance, presentation, orientation);
        let back = Intrinsic::from(Geometry::from(given));
        assert_near("observation", given.observation, back.observation);
        assert_near("entrance", given.entrance, back.entrance);
        assert_near("presentation", given.presentation, back.presentation);
        assert_near("orientation", given.orientation, back.orientation);
    }

    #[test]
    fn road_marking_angles_come_back(
        co_entrance in 0.1_f64..89.0, co_viewing in 0.1_f64..89.0,
        dihedral in -179.0_f64..180.0, orientation in -179.0_f64..180.0,
    ) {
        let given = RoadMarking::from_degrees(co_entrance, co_viewing, dihedral, orientation);
        let back = RoadMarking::from(Geometry::from(given));
        assert_near("co_entrance", given.co_entrance, back.co_entrance);
        assert_near("co_viewing", given.co_viewing, back.co_viewing);
        assert_near("dihedral", given.dihedral, back.dihedral);
        assert_near("orientation", given.orientation, back.orientation);
    }

    #[test]
    fn entrance_components_make_the_entrance_angle(
        observation in 0.1_f64..10.0, entrance_1 in -80.0_f64..80.0, entrance_2 in -80.0_f64..80.0,
    ) {
        // ASTM E808: cos beta = cos beta_1 cos beta_2.
        let angles = Goniometer::from_degrees(observation, entrance_1, entrance_2, 0.0);
        let cos = angles.entrance_1.cos() * angles.entrance_2.cos();
        assert!((Geometry::from(angles).entrance().cos() - cos).abs() < 1e-15);
    }

    #[test]
    fn both_systems_of_sheeting_mean_the_same_directions(
        observation in 0.1_f64..10.0, entrance_1 in -80.0_f64..80.0,
        entrance_2 in -80.0_f64..80.0, rotation in -179.0_f64..180.0,
    ) {
        let goniometer = Goniometer::from_degrees(observation, entrance_1, entrance_2, rotation);
        let geometry = Geometry::from(goniometer);
        let same = Geometry::from(Intrinsic::from(geometry));
        for (a, b) in [(geometry.wo, same.wo), (geometry.wi, same.wi)] {
            let distance = (a.x - b.x).abs() + (a.y - b.y).abs() + (a.z - b.z).abs();
            assert!(distance < ROUND_TRIP, "{a:?} became {b:?}");
        }
    }
}

#[test]
fn small_observation_angles_keep_their_digits() {
    for deg in [1e-3_f64, 0.1, 0.2, 1.0 / 3.0, 1.5] {
        for entrance in [-4.0, 0.0, 5.0, 30.0, 60.0, 88.76] {
            for rotation in [0.0, 37.0] {
                let geometry = Geometry::from(Goniometer::from_degrees(deg, entrance, 0.0, rotation));
                let error = (geometry.observation() / deg.to_radians() - 1.0).abs();
                // One rounding of a direction, 1.1e-16, over the angle, and another for the chord's
                // components.
                let rounding = 4e-16 / deg.to_radians();
                assert!(error < rounding, "{deg} at {entrance}: off by {error:e}");
                assert!(deg < 0.1 || error < 1e-12, "{deg} at {entrance}: off by {error:e}");
                assert_near("entrance", geometry.entrance(), entrance.to_radians().abs());
            }
        }
    }
}

#[test]
fn a_positive_entrance_angle_tips_the_axis_towards_the_receiver() {
    let viewing = |entrance| Geometry::from(Goniometer::from_degrees(0.2, entrance, 0.0, 0.0)).viewing();
    assert_near("viewing at 30", viewing(30.0), 29.8_f64.to_radians());
    assert_near("viewing at -4", viewing(-4.0), 4.2_f64.to_radians());
}

#[test]
fn the_glare_of_the_front_surface_misses_the_receiver_by_twice_the_entrance_angle_and_more() {
    let geometry = Geometry::from(Goniometer::from_degrees(0.2, -4.0, 0.0, 0.0));
    let Geometry { wo, wi } = geometry;
    let mirrored = Geometry { wo, wi: Vec3::new(-wi.x, -wi.y, wi.z) };
    assert_near("glare", mirrored.observation(), 8.2_f64.to_radians());
}

#[test]
fn rotation_is_counter_clockwise_seen_from_the_source() {
    // The receiver is above the source; a datum axis turned by +90 degrees points to the source's left, from
    // where the receiver's azimuth is -90 degrees.
    let geometry = Geometry::from(Goniometer::from_degrees(1.0, 0.0, 0.0, 90.0));
    assert!(geometry.wo.y < -0.017 && geometry.wo.x.abs() < 1e-12, "{geometry:?}");
}

#[test]
fn the_30_m_geometry_has_the_angles_that_standards_give() {
    let geometry = Geometry::from(RoadMarking::standard_30_m());
    assert_near("observation", geometry.observation(), 1.05_f64.to_radians());
    assert_near("entrance", geometry.entrance(), 88.76_f64.to_radians());
    assert_near("presentation", Intrinsic::from(geometry).presentation, 0.0);
    let sheeting = Goniometer::from(geometry);
    assert_near("entrance_1", sheeting.entrance_1, 88.76_f64.to_radians());
    assert_near("entrance_2", sheeting.entrance_2, 0.0);
}

#[test]
fn degenerate_directions_have_angles_that_lead_back_to_them() {
    let axis = Vec3::new(0.0, 0.0, 1.0);
    let slanted = Vec3::new(0.6, 0.0, 0.8);
    let horizontal = Vec3::new(0.0, -1.0, 0.0);
    for wi in [axis, slanted, horizontal] {
        for wo in [axis, slanted, horizontal, wi] {
            let given = Geometry { wo, wi };
            let all = [
                Geometry::from(Goniometer::from(given)),
                Geometry::from(Intrinsic::from(given)),
                Geometry::from(RoadMarking::from(given)),
            ];
            for (i, back) in all.into_iter().enumerate() {
                // The road-marking system gives up the azimuth of a receiver above a source that has none.
                if i == 2 && wi == axis {
                    continue;
                }
                for (a, b) in [(given.wo, back.wo), (given.wi, back.wi)] {
                    assert!(
                        (a.x - b.x).abs() + (a.y - b.y).abs() + (a.z - b.z).abs() < 1e-12,
                        "{given:?} {back:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn gimbal_lock_of_the_goniometer_is_legal() {
    let given = Geometry::from(Goniometer {
        observation: 0.01,
        entrance_1: 0.3,
        entrance_2: FRAC_PI_2,
        rotation: 0.2,
    });
    let back = Geometry::from(Goniometer::from(given));
    assert!(
        (given.wo.x - back.wo.x).abs() < 1e-12 && (given.wo.y - back.wo.y).abs() < 1e-12,
        "{given:?} {back:?}"
    );
}
