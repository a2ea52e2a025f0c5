//! Single precision against double precision on the same inputs, where the lobe is narrow.

use crate::common::{Random, directions, to_f32};
use catseye::{Lobe as _, Params, Reciprocal, Vec3};

/// Largest relative error of f and pdf over pairs inside the lobe: those within 1e-6 of its peak.
fn worst(roughness: [f64; 2], multiscatter_tint: f64) -> Option<f64> {
    let [u, v] = roughness.map(|r| r as f32);
    let params = Params::anisotropic(u, v).with_multiscatter_tint([multiscatter_tint as f32; 3]);
    let single = Reciprocal::<f32>::new(&params).ok()?;
    let params =
        Params::anisotropic(f64::from(u), f64::from(v)).with_multiscatter_tint([multiscatter_tint; 3]);
    let double = Reciprocal::<f64>::new(&params).ok()?;
    let back = |w: Vec3<f32>| Vec3::new(f64::from(w.x), f64::from(w.y), f64::from(w.z));
    let mut random = Random(13);
    let mut worst = 0.0_f64;
    for wo in directions() {
        let wo = to_f32(wo);
        let peak = double.eval(back(wo), back(wo))[0];
        for _ in 0..20_000 {
            let wi = to_f32(double.sample(back(wo), random.triple())?.wi);
            let ((f, pdf), (f_exact, pdf_exact)) =
                (single.eval_pdf(wo, wi), double.eval_pdf(back(wo), back(wi)));
            if f_exact[0] > 1e-6 * peak {
                worst = worst.max((f64::from(f[0]) / f_exact[0] - 1.0).abs());
                worst = worst.max((f64::from(pdf) / pdf_exact - 1.0).abs());
            }
        }
    }
    Some(worst)
}

#[test]
fn sheeting_is_within_2e_3() {
    for roughness in
        [[0.003, 0.003], [0.006, 0.006], [0.01, 0.01], [0.003, 0.01], [0.01, 0.2], [0.1, 0.1], [1.0, 1.0]]
    {
        for multiscatter_tint in [0.0, 1.0] {
            let worst = worst(roughness, multiscatter_tint).expect("legal parameters and directions");
            println!("{roughness:?} multiscatter_tint {multiscatter_tint}: {worst:.1e}");
            assert!(worst < 2e-3, "{roughness:?}: {worst:.1e}");
        }
    }
}
