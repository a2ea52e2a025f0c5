//! Fresnel's equations (Born and Wolf, "Principles of Optics", section 1.5) between transparent media.

use nalgebra::Complex;

/// Powers that pass a surface between media of the relative index m (behind over before), s and p polarised;
/// x is the sine of the angle of incidence, 0 to 1. From the dense side use [`reflected`].
pub(crate) fn transmitted(x: f64, m: f64) -> [f64; 2] {
    let [before, behind] = [(1.0 - x * x).max(0.0).sqrt(), (1.0 - (x / m).powi(2)).max(0.0).sqrt()];
    let reflected =
        [(before - m * behind) / (before + m * behind), (m * before - behind) / (m * before + behind)];
    reflected.map(|r| 1.0 - r * r)
}

/// Amplitudes that glass of index n reflects into itself at its surface to air, s and p polarised; `cos` is
/// the cosine of the angle of incidence, 0 to 1.
///
/// Time goes as exp(-i omega t), and the p vectors are s x k before and after. Beyond the critical angle the
/// amplitudes have modulus 1, and their phases differ.
pub(crate) fn reflected(cos: f64, n: f64) -> [Complex<f64>; 2] {
    let refracted = Complex::new(1.0 - n * n * (1.0 - cos * cos), 0.0).sqrt();
    let ratio = |before: f64, behind: Complex<f64>| (-behind + before) / (behind + before);
    [ratio(n * cos, refracted), ratio(cos, refracted * n)]
}
