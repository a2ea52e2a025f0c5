//! Promise: quantities are known by their names, and follow from the BSDF.

use std::f64::consts::PI;

use catseye_photometry::{Geometry, Goniometer, Quantity};

#[test]
fn symbols_are_read_back() {
    for quantity in Quantity::ALL {
        assert_eq!(quantity.symbol().parse::<Quantity>().ok(), Some(quantity));
        assert_eq!(quantity.symbol().to_lowercase().parse::<Quantity>().ok(), Some(quantity));
    }
    assert_eq!("CIL".parse::<Quantity>().ok(), Some(Quantity::LuminousIntensity));
    assert!("R_X".parse::<Quantity>().is_err());
}

#[test]
fn a_white_diffuser_has_luminance_factor_1() {
    let geometry = Geometry::from(Goniometer::from_degrees(45.0, 45.0, 0.0, 0.0));
    assert_eq!(Quantity::LuminanceFactor.of_brdf(PI.recip(), &geometry), Some(1.0));
    let r_a = Quantity::RetroReflectionCoefficient.of_brdf(PI.recip(), &geometry).unwrap();
    assert!((r_a - 0.5_f64.sqrt() / PI).abs() < 1e-15, "0/45: the receiver is on the axis");
}
