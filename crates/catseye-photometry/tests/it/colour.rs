//! Promise: a colour has luminance 1, by whatever name a table calls it.

use catseye_photometry::{Colour, luminance};

#[test]
fn a_table_s_words_name_a_colour() {
    let same = |text: &str, name: &str| assert_eq!(Colour::named(text), Colour::named(name), "{text}");
    same("white (silver)", "white");
    same("yellow / fluorescent yellow", "yellow");
    same("Fluorescent Yellow-Green", "fluorescent lime-yellow");
    assert_ne!(Colour::named("fluorescent yellow"), Colour::named("yellow"));
    assert_eq!(Colour::named("infra-dark"), None);
    assert_eq!("0.5, 0.5, 0.5".parse::<Colour>(), Ok(Colour::WHITE));
    assert!("1,2".parse::<Colour>().is_err() && "0,0,0".parse::<Colour>().is_err());
}

#[test]
fn colours_have_luminance_1() {
    for name in Colour::names() {
        let rgb = Colour::named(name).map(|colour| colour.of_luminance(1.0)).unwrap();
        assert!((luminance(rgb) - 1.0).abs() < 1e-12, "{name}");
    }
}
