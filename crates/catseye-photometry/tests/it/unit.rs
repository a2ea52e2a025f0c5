//! Promise: units are read in the spellings of data sheets, and numbers keep their digits.

use catseye_photometry::{Quantity, Unit};

#[test]
fn spellings_of_data_sheets_are_one_unit() {
    let same = [
        "cd/lx/m2",
        "cd/(lx.m2)",
        "cd/(lx·m²)",
        "cd.lx-1.m-2",
        "cd·lx⁻¹·m⁻²",
        "cd/lux/m2",
        "cd/lux/m^2",
        " CD/LX/M2 ",
        "cd / lx / m2",
        "cd/m²/lx",
        "cd/lx/m2 (R_A)",
    ];
    for text in same {
        assert_eq!(text.parse::<Unit>().ok(), Some(Unit::CandelaPerLuxSquareMetre), "{text}");
    }
    for text in ["cd/fc/ft2", "cd/ft-c/ft2", "cd/fc/ft²"] {
        assert_eq!(text.parse::<Unit>().ok(), Some(Unit::CandelaPerFootcandleSquareFoot), "{text}");
    }
    for unit in Unit::ALL {
        assert_eq!(unit.symbol().parse::<Unit>().ok(), Some(unit));
        assert!(unit.measures(unit.usual_quantity()));
    }
}

#[test]
fn numbers_keep_their_digits_through_units() {
    assert_eq!(Unit::MillicandelaPerLuxSquareMetre.to_si(150.0), 0.15);
    assert_eq!(Unit::Percent.to_si(27.0), 0.27);
    assert!((Unit::CandelaPerFootcandle.of_si(1.0) - 10.763_910_416_709_722).abs() < 1e-12);
}

#[test]
fn a_remark_names_the_quantity() {
    let parsed = |text| Unit::parse_with_quantity(text).ok();
    let road = (Unit::MillicandelaPerLuxSquareMetre, Quantity::RetroReflectedLuminance);
    assert_eq!(parsed("mcd/lx/m2 (R_L)"), Some(road));
    assert_eq!(parsed("mcd/lx (CIL)"), Some((Unit::MillicandelaPerLux, Quantity::LuminousIntensity)));
    assert_eq!(
        parsed("mcd/lx/m2 (Q_d)"),
        Some((Unit::MillicandelaPerLuxSquareMetre, Quantity::DaytimeLuminance))
    );
}

#[test]
fn an_unknown_unit_is_told_the_known_ones() {
    let error = "furlongs".parse::<Unit>().expect_err("no unit").to_string();
    assert!(error.contains("furlongs") && error.contains("cd/lx/m2"), "{error}");
}
