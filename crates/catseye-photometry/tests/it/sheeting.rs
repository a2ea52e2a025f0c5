//! Promise: a lobe with an entrance law keeps its angular width and follows its law, and what is no sheeting
//! is found out.

use catseye::{Lobe as _, Model, Params, Reciprocal, Vec3};
use catseye_photometry::{EntranceLaw, Geometry, Goniometer, Quantity, RetroLobe, Sheeting};

fn sheeting(roughness: f64, law: EntranceLaw) -> Sheeting {
    let lobe = RetroLobe { strength: 0.06, roughness: [roughness; 2], entrance: Some(law) };
    Sheeting { lobes: vec![lobe], ..Sheeting::default() }
}

fn r_a(sheeting: &Sheeting, observation_deg: f64, entrance_deg: f64) -> f64 {
    let geometry = Geometry::from(Goniometer::from_degrees(observation_deg, entrance_deg, 0.0, 0.0));
    let f = sheeting.prepare().unwrap().eval(geometry.wo, geometry.wi);
    Quantity::RetroReflectionCoefficient.of_brdf(f, &geometry).unwrap()
}

const BEND: EntranceLaw = EntranceLaw { slope: 4.0, bend: 0.6, sharpness: 5.0 };

#[test]
fn at_observation_angle_0_r_a_follows_the_law() {
    for law in [EntranceLaw::power(3.0), BEND] {
        let sheeting = sheeting(0.006, law);
        for entrance_deg in [5.0_f64, 20.0, 30.0, 40.0, 60.0, 75.0] {
            let share = r_a(&sheeting, 0.0, entrance_deg) / r_a(&sheeting, 0.0, 0.0);
            // The width of a roughness is proportional to it up to its square.
            let expected = law.at(entrance_deg.to_radians().cos());
            assert!((share / expected - 1.0).abs() < 2e-4, "{law:?} {entrance_deg}: {share} {expected}");
        }
    }
}

#[test]
fn the_width_is_the_same_at_every_entrance_angle() {
    // Half-power angle 0.4 degrees. The node's own lobe has 0.508 of its peak there at 0 degrees and 0.068 at
    // 60.
    let sheeting = sheeting(0.005_929_4, EntranceLaw::power(1.0));
    for entrance_deg in [0.0, 15.0, 30.0, 45.0, 60.0] {
        for observation_deg in [0.1, 0.2, 0.4] {
            let shape = |entrance_deg| {
                r_a(&sheeting, observation_deg, entrance_deg) / r_a(&sheeting, 0.0, entrance_deg)
            };
            let (here, at_normal) = (shape(entrance_deg), shape(0.0));
            assert!(
                (here / at_normal - 1.0).abs() < 0.02,
                "{entrance_deg} {observation_deg}: {here} {at_normal}"
            );
        }
    }
}

#[test]
fn the_lobe_is_the_node_s_with_its_tangent_along_the_projection() {
    let (r, law) = (0.05, EntranceLaw::power(2.0));
    for model in [Model::Reciprocal, Model::Edwards] {
        let sheeting = Sheeting { model, ..sheeting(r, law) };
        for (zenith, azimuth) in [(0.6, 0.0), (0.6, 1.0), (1.2, -2.0)] {
            let wo = Vec3::from_angles(zenith, azimuth);
            let wi = Vec3::from_angles(zenith + 0.03, azimuth + 0.02);
            let [turned_o, turned_i] =
                [Vec3::from_angles(zenith, 0.0), Vec3::from_angles(zenith + 0.03, 0.02)];
            let params = Params::anisotropic(r / wo.z, r);
            let node = match model {
                Model::Reciprocal => Reciprocal::new(&params).unwrap().eval(turned_o, turned_i)[0],
                _ => catseye::Edwards::new(&params).unwrap().eval(turned_o, turned_i)[0],
            };
            let expected = 0.06 * law.at(wo.z) / wo.z * node;
            let found = sheeting.prepare().unwrap().eval(wo, wi);
            assert!(
                (found / expected - 1.0).abs() < 1e-9,
                "{model:?} {zenith} {azimuth}: {found} {expected}"
            );
        }
    }
}

#[test]
fn the_energy_is_bounded_where_the_tint_is_greatest() {
    // Flat up to 63 degrees: over N.V the tint grows to twice what it is at normal incidence.
    let law = EntranceLaw { slope: 6.0, bend: 4.0, sharpness: 12.0 };
    let bound = sheeting(0.006, law).albedo_bound();
    let greatest = (0..1000).map(|i| 0.01 + 0.99e-3 * f64::from(i)).map(|c| 0.06 * law.at(c) / c);
    let greatest = greatest.fold(0.0, f64::max);
    assert!(greatest > 0.1 && (bound / greatest - 1.0).abs() < 5e-3, "{bound} {greatest}");
}

#[test]
fn the_laws_of_a_fit_are_sheeting_and_an_edge_is_not() {
    let angles = [0.2_f64.to_radians(), 0.5_f64.to_radians()];
    // The corners of what a fit looks for.
    for slope in [1.0, 6.0] {
        for bend in [1.0 / 3.0, 7.55] {
            for sharpness in [2.0, 12.0] {
                let law = EntranceLaw { slope, bend, sharpness };
                assert_eq!(sheeting(0.006, law).fault(&angles), None, "{law:?}");
            }
        }
    }
    let edge = EntranceLaw { slope: 20.0, bend: 0.5, sharpness: 12.0 };
    let fault = sheeting(0.006, edge).fault(&angles).unwrap();
    assert!(fault.r_a[1] * 10.0 < fault.r_a[0] && fault.entrance_deg[1] > 35.0, "{fault:?}");
    // A law that rises: a lobe that glows towards the horizon.
    let glow = sheeting(0.006, EntranceLaw::power(-0.5)).fault(&angles).unwrap();
    assert!(glow.r_a[1] > 1.1 * glow.r_a[0], "{glow:?}");
}
