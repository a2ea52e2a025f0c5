//! Beads and cubes: known coefficients, and what is refused.

use catseye_photometry::optics::{Back, Beads, Coating, Cubes, Light, Mount, PreparedBeads, PreparedCubes};
use catseye_photometry::{Error, Geometry, Goniometer};

fn at(observation: f64, entrance: f64, rotation: f64) -> Geometry {
    Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, rotation))
}

fn bead(beads: Beads) -> PreparedBeads {
    beads.prepare().unwrap()
}

fn cube(cubes: Cubes) -> PreparedCubes {
    cubes.prepare().unwrap()
}

/// Enclosed beads of index 2.2 in 1.5, the reflector at a part of the focus.
fn enclosed(part: f64) -> Beads {
    let mount = Mount::Enclosed { medium: 1.5, spacing: part * Beads::focus(2.2, 1.5), film: 1.0 };
    Beads { index: 2.2, mount, ..Beads::default() }
}

#[test]
fn beads_in_white_light_have_their_known_coefficients() {
    // numpy with 7 wavelengths, sizes within 10 % and the paraxial phase: other samples of both, so that the
    // height is met within 4 % and what the fringes fill up within 15 %.
    for (beads, values) in [
        (Beads { index: 1.9, ..Beads::default() }, [513.0, 486.0, 408.0, 268.0, 84.0]),
        (Beads::default(), [634.0, 612.0, 544.0, 413.0, 11.0]),
        (Beads { index: 2.0, ..Beads::default() }, [146.0, 144.0, 138.0, 124.0, 34.0]),
        (Beads { index: 2.2, ..Beads::default() }, [4.16, 4.15, 4.13, 4.11, 3.92]),
        (
            Beads { index: 1.9, mount: Mount::ENCAPSULATED, ..Beads::default() },
            [326.0, 308.0, 259.0, 170.0, 54.0],
        ),
        (enclosed(1.0), [67.6, 66.9, 64.8, 60.4, 25.0]),
        (enclosed(0.97), [188.0, 185.0, 175.0, 154.0, 24.0]),
    ] {
        let prepared = bead(beads);
        for (observation, expected) in [0.02, 0.1, 0.2, 0.33, 1.0].into_iter().zip(values) {
            let found = prepared.r_a(&at(observation, 0.0, 0.0));
            let bound = if observation < 0.3 { 0.04 } else { 0.15 };
            assert!((found / expected - 1.0).abs() < bound, "{beads:?} {observation}: {found} {expected}");
        }
    }
}

#[test]
fn larger_beads_are_brighter_near_the_axis() {
    let found = [40.0, 60.0, 100.0]
        .map(|diameter_um| bead(Beads { diameter_um, ..Beads::default() }).r_a(&at(0.2, 0.0, 0.0)));
    for (found, expected) in found.into_iter().zip([330.0, 544.0, 689.0]) {
        assert!((found / expected - 1.0).abs() < 0.04, "{found} {expected}");
    }
}

#[test]
fn beads_on_white_paint_have_their_known_coefficients() {
    // The geometric integral in numpy; 6 million rays agree with it within 1 % for n = 1.5. Beads of 1 mm,
    // which diffraction does not change there.
    let paint =
        |index, diameter_um| bead(Beads { index, diameter_um, back: Back::Diffuse(0.8), ..Beads::default() });
    let large = paint(1.5, 1000.0);
    for (observation, expected) in [(0.5, 1.693), (1.1, 1.407), (4.5, 0.891)] {
        let found = large.r_a(&at(observation, 0.0, 0.0));
        assert!((found / expected - 1.0).abs() < 0.01, "{observation}: {found}");
    }
    let bright = paint(1.93, 1000.0);
    for (observation, expected) in [(0.5, 25.8), (1.1, 5.02), (4.5, 0.80)] {
        let found = bright.r_a(&at(observation, 0.0, 0.0));
        assert!((found / expected - 1.0).abs() < 0.03, "{observation}: {found}");
    }
    // A focus can't be smaller than diffraction makes it.
    assert!(paint(1.93, 30.0).r_a(&at(0.1, 0.0, 0.0)) < 0.5 * bright.r_a(&at(0.1, 0.0, 0.0)));
}

#[test]
fn beads_hide_behind_each_other_at_a_slant() {
    for (packing, shares) in [
        (0.65, [0.986, 0.941, 0.861, 0.768, 0.622, 0.357]),
        (0.80, [0.986, 0.941, 0.860, 0.731, 0.517, 0.225]),
    ] {
        let beads = bead(Beads { packing, ..Beads::default() });
        let head_on = beads.r_a(&at(0.0, 0.0, 0.0));
        for (entrance, expected) in [10.0, 20.0, 30.0, 40.0, 50.0, 60.0].into_iter().zip(shares) {
            let share = beads.r_a(&at(0.0, entrance, 0.0)) / head_on;
            // The shares are of a count of random rays, with a noise of 1 %.
            assert!((share - expected).abs() < 0.01, "{packing} {entrance}: {share}");
        }
    }
    let lone = bead(Beads { packing: 1e-3, ..Beads::default() });
    let share = lone.r_a(&at(0.0, 60.0, 0.0)) / lone.r_a(&at(0.0, 0.0, 0.0));
    assert!((share - 0.5).abs() < 1e-12, "cos of the entrance angle: {share}");
}

#[test]
fn a_flat_front_takes_its_part() {
    // (cos b / cos b')^2 T^2 with Fresnel's T, in numpy.
    let beads = bead(enclosed(1.0));
    let head_on = beads.r_a(&at(0.0, 0.0, 0.0));
    for (entrance, expected) in
        [(10.0, 0.983), (20.0, 0.931), (30.0, 0.841), (40.0, 0.710), (50.0, 0.539), (60.0, 0.338)]
    {
        let share = beads.r_a(&at(0.0, entrance, 0.0)) / head_on;
        assert!((share - expected).abs() < 6e-4, "{entrance}: {share}");
    }
}

#[test]
fn cubes_in_white_light_have_their_known_coefficients() {
    // numpy, index 1.5, no losses of area, the mean over all azimuths at an entrance angle of 5 degrees.
    let cubes = Cubes { index: 1.5, fill: 1.0, error_sd_arcmin: 0.0, ..Cubes::default() };
    for (error, values) in [
        (0.0, [4821.0, 2003.0, 1743.0, 616.0]),
        (4.0, [1829.0, 1110.0, 1505.0, 827.0]),
        (10.0, [79.0, 57.0, 108.0, 252.0]),
    ] {
        let prepared = cube(Cubes { errors_arcmin: [error; 3], ..cubes });
        for (observation, expected) in [0.1, 0.2, 0.33, 0.5].into_iter().zip(values) {
            let found = prepared.r_a(&at(observation, 5.0, 0.0));
            // It turned the receiver about the source, not the sheet about its normal.
            assert!((found / expected - 1.0).abs() < 0.03, "{error} {observation}: {found}");
        }
    }
}

#[test]
fn cubes_show_where_they_are_turned_beyond_total_reflection() {
    let cubes = cube(Cubes { index: 1.5, error_sd_arcmin: 0.0, azimuth_deg: Some(0.0), ..Cubes::default() });
    let value = |entrance, rotation| cubes.r_a(&at(0.2, entrance, rotation));
    for rotation in [0.0, 17.0, 30.0] {
        // Pairs of equal cubes: six-fold, and symmetric about the first edge.
        assert!((value(30.0, rotation) / value(30.0, rotation + 60.0) - 1.0).abs() < 1e-9);
        assert!((value(30.0, rotation) / value(30.0, -rotation) - 1.0).abs() < 1e-9);
    }
    assert!(value(30.0, 0.0) > 2.0 * value(30.0, 30.0));
    let [flat, turned] = [0.0, 30.0].map(|rotation| value(5.0, rotation));
    assert!((flat / turned - 1.0).abs() < 0.2, "{flat} {turned}");
}

#[test]
fn exchanging_source_and_receiver_changes_nothing() {
    let swapped = |g: Geometry| Geometry { wo: g.wi, wi: g.wo };
    for geometry in [at(0.3, 20.0, 10.0), at(1.5, -35.0, 40.0)] {
        for beads in [Beads::default(), enclosed(1.0)] {
            let beads = bead(beads);
            assert!((beads.r_a(&geometry) / beads.r_a(&swapped(geometry)) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn directions_below_the_surface_send_nothing_back() {
    let below = at(10.0, -85.0, 0.0);
    assert!(!below.is_above_horizon());
    assert_eq!(bead(Beads::default()).r_a(&below), 0.0);
    assert_eq!(cube(Cubes::default()).r_a(&below), 0.0);
}

#[test]
fn numbers_out_of_range_are_named() {
    let beads = Beads::default();
    let in_medium = |medium, spacing, film| Mount::Enclosed { medium, spacing, film };
    for (wrong, message) in [
        (Beads { index: 1.0, ..beads }, "the bead's index is 1, outside (1, 3]"),
        (Beads { index: f64::NAN, ..beads }, "the bead's index is NaN, outside (1, 3]"),
        (Beads { diameter_um: 0.0, ..beads }, "the diameter is 0, outside [5, 1000] um"),
        (Beads { diameter_um: 1e9, ..beads }, "the diameter is 1000000000, outside [5, 1000] um"),
        (Beads { spread: 0.5, ..beads }, "the spread is 0.5, outside [0, 0.3] of the diameter"),
        (Beads { packing: 0.95, ..beads }, "the packing is 0.95, outside (0, 0.9069]"),
        (Beads { back: Back::Specular(0.0), ..beads }, "the reflectance is 0, outside (0, 1]"),
        (
            Beads { light: Light::Monochromatic(100.0), ..beads },
            "the wavelength is 100, outside [300, 2000] nm",
        ),
        (
            Beads { mount: in_medium(2.0, 1.5, 1.0), ..beads },
            "the bead's index is 1.93, outside (that of the medium, 3]",
        ),
        (Beads { mount: in_medium(1.5, 0.5, 1.0), ..beads }, "the spacing is 0.5, outside [1, 4] bead radii"),
        (Beads { mount: in_medium(1.5, 1.5, 2.0), ..beads }, "the film's transmittance is 2, outside (0, 1]"),
        (
            Beads { mount: in_medium(1.5, 1.5, 1.0), back: Back::Diffuse(0.8), ..beads },
            "the spacing of a diffuse reflector is 1.5, outside what is modelled: a diffuse reflector lies on \
             beads in air",
        ),
    ] {
        assert_eq!(wrong.prepare().unwrap_err().to_string(), message);
    }
    let cubes = Cubes::default();
    for (wrong, message) in [
        (Cubes { index: 0.9, ..cubes }, "the cubes' index is 0.9, outside (1, 3]"),
        (Cubes { leg_um: 0.0, ..cubes }, "the leg is 0, outside [10, 10000] um"),
        (
            Cubes { errors_arcmin: [0.0, 90.0, 0.0], ..cubes },
            "a dihedral error is 90, outside [-60, 60] arc minutes",
        ),
        (
            Cubes { error_sd_arcmin: -1.0, ..cubes },
            "the random dihedral error is -1, outside [0, 60] arc minutes",
        ),
        (Cubes { azimuth_deg: Some(400.0), ..cubes }, "the azimuth is 400, outside [-360, 360] degrees"),
        (Cubes { coating: Coating::Metal(2.0), ..cubes }, "the reflectance is 2, outside (0, 1]"),
        (Cubes { fill: 0.0, ..cubes }, "the fill is 0, outside (0, 1]"),
    ] {
        let error = wrong.prepare().unwrap_err();
        assert!(matches!(error, Error::Range { .. }));
        assert_eq!(error.to_string(), message);
    }
}
