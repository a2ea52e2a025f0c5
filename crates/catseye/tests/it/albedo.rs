//! The albedo in its three forms: closed-form values, the reference's numbers, and the fits' stated error
//! bounds.

use crate::common::Random;
use catseye::albedo::exact::{self, Quadrature};
use catseye::albedo::{CompactFit, FastFit};
use catseye::{Vec3, width};

/// Roughness over its whole range, also 0 and infinity.
fn roughness(u: f64) -> f64 {
    if u < 0.03 {
        0.0
    } else if u > 0.97 {
        f64::INFINITY
    } else {
        10.0_f64.powf(-3.0 + 5.0 * (u - 0.03) / 0.94)
    }
}

#[test]
fn closed_forms() {
    let normal = Vec3::new(0.0, 0.0, 1.0);
    // rho(0, n) = (n+1)/(n+4) 2F1(3, 1; n+5; -1), theory.md section 4.
    for (n, rho) in [(0.0, 0.158_883_083_359_67), (2.0, 0.355_323_334_386_87), (20.0, 0.783_680_788_663_58)] {
        let r = (2.0_f64 / n).sqrt();
        assert!(
            (exact::directional([r, r], normal) - rho).abs() < 1e-9,
            "n = {n}: {}",
            exact::directional([r, r], normal)
        );
    }
    let grazing = Vec3::new(1.0, 0.0, 2e-9);
    assert!((exact::directional([1.0, 1.0], grazing) - 0.5).abs() < 1e-9);
    assert!(
        (exact::average([f64::INFINITY; 2]) - 0.25).abs() < 1e-9,
        "{}",
        exact::average([f64::INFINITY; 2])
    );
    assert!((exact::average([1.0, 1.0]) - 0.453_125).abs() < 1e-9, "{}", exact::average([1.0, 1.0]));
    assert_eq!(exact::directional([0.0, 0.0], normal), 1.0);
}

/// An isotropic lobe knows no azimuth, but the rule does: its breaks lie elsewhere for each one.
#[test]
fn the_quadrature_is_the_same_along_every_azimuth() {
    for r in [0.3, 1.2, 3.0, 5.0, 50.0] {
        for theta in [0.5, 1.2, 1.4, 1.52, 1.569] {
            let rho = |phi: f64| exact::directional([r, r], Vec3::from_angles(theta, phi));
            for phi in [0.3, 0.785, 1.2, 1.57, 2.5] {
                let difference = (rho(phi) - rho(0.0)).abs();
                assert!(difference < 1e-12, "r {r}, theta {theta}, phi {phi}: {difference:e}");
            }
        }
    }
}

#[test]
fn fits_keep_their_bounds() {
    let rule = Quadrature::new();
    let mut random = Random(17);
    let mut worst = [0.0_f64; 4];
    for i in 1..6000 {
        let isotropic = i % 3 == 0;
        let m_u = width(roughness(random.uniform()).max(1e-4));
        let m_v = if isotropic { m_u } else { width(roughness(random.uniform()).max(1e-4)) };
        let sine = if i % 2 == 0 { random.uniform() } else { random.uniform().sqrt() };
        let (sin, cos) = (std::f64::consts::TAU * random.uniform()).sin_cos();
        let (x, y) = (sine * cos, sine * sin);
        let exact = rule.loss([m_u, m_v], [x, y]);
        let fast = FastFit::new([m_u, m_v]).loss(x, y);
        let compact = CompactFit::new([m_u, m_v]).loss(x, y);
        let fast_f32 = FastFit::new([m_u as f32, m_v as f32]).loss(x as f32, y as f32);
        let slot = usize::from(!isotropic);
        worst[slot] = worst[slot].max((fast - exact).abs()).max((f64::from(fast_f32) - exact).abs());
        worst[2 + slot] = worst[2 + slot].max((compact - exact).abs());
    }
    println!("fast {:.2e} {:.2e}, compact {:.2e} {:.2e}", worst[0], worst[1], worst[2], worst[3]);
    assert!(worst[0] < 1e-4 && worst[1] < 1e-3 && worst[2] < 2e-3 && worst[3] < 5e-3);
}
