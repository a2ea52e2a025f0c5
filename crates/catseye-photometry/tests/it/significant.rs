//! Promise: numbers are written with the digits that mean something.

use catseye_photometry::significant;

#[test]
fn digits_are_counted_from_the_first_that_is_not_zero() {
    let cases =
        [(0.012_345, 3, "0.0123"), (-2.5, 4, "-2.5"), (1234.5, 2, "1234"), (300.0, 3, "300"), (0.0, 3, "0")];
    for (value, digits, text) in cases {
        assert_eq!(significant(value, digits), text);
    }
    assert_eq!(significant(f64::INFINITY, 3), "inf");
}
