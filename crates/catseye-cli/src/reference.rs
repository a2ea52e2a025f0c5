//! The mean albedo that a lobe must have, as exactly as it can be had.

use catseye::albedo::exact;
use catseye::{AnyLobe, Lobe as _, Model, ParamError, Params, Vec3};

/// Cosines and azimuths of the directions that other models' mean is taken over.
const AVERAGE: [u32; 2] = [128, 16];

/// The cosine-weighted mean of the directional albedo over the hemisphere, what a sphere in a white furnace shows.
pub(crate) fn average(model: Model, params: &Params<f64>) -> Result<[f64; 3], ParamError> {
    if model == Model::Reciprocal {
        params.validate()?;
        let rho = exact::average(params.roughness());
        return Ok([0, 1, 2].map(|c| params.tint[c] * rho + params.multiscatter_tint[c] * (1.0 - rho)));
    }
    let lobe = AnyLobe::new(model, params)?;
    let [cosines, azimuths] = AVERAGE.map(f64::from);
    let mut sum = [0.0; 3];
    for i in 0..AVERAGE[0] {
        for k in 0..AVERAGE[1] {
            // Midpoints, evenly spread over the disk that the hemisphere is seen as.
            let cos_theta = ((f64::from(i) + 0.5) / cosines).sqrt();
            let phi = (f64::from(k) + 0.5) / azimuths * std::f64::consts::TAU;
            for (sum, value) in sum.iter_mut().zip(lobe.albedo(Vec3::from_angles(cos_theta.acos(), phi))) {
                *sum += value;
            }
        }
    }
    Ok(sum.map(|sum| sum / (cosines * azimuths)))
}
