//! Glass beads with a reflector behind them.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use super::diffuse::DiffuseBack;
use super::fresnel::transmitted;
use super::light::Light;
use super::packing::visible_share;
use super::{MAX_OBSERVATION_DEG, within};
use crate::gauss::gauss;
use crate::{Error, Geometry};
use catseye::Vec3;

/// Index of the cover film of encapsulated beads.
const FILM_INDEX: f64 = 1.5;
/// Nodes over sizes and wavelengths together.
const SIZES: usize = 24;

/// A layer of equal glass beads. Start from [`Beads::default`]: exposed beads of index 1.93 and 60 um, white
/// light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beads {
    /// Refractive index of the glass, above 1 and above that of the medium it lies in, at most 3.
    pub index: f64,
    /// Mean diameter in micrometres, 5 to 1000.
    pub diameter_um: f64,
    /// Standard deviation of the diameter over its mean, 0 to 0.3.
    pub spread: f64,
    /// What is before the beads and between them and the reflector.
    pub mount: Mount,
    /// The reflector.
    pub back: Back,
    /// Share of the sheet's area that the beads' cross sections cover, above 0, at most 0.9069 (hexagonal).
    pub packing: f64,
    /// The light.
    pub light: Light,
}

/// Where beads lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount {
    /// Their front half in air, the reflector on their back half.
    Exposed,
    /// As [`Mount::Exposed`], in cells with air below a cover film of index 1.5.
    Encapsulated {
        /// Transmittance of the film's inside once through along its normal, above 0, at most 1.
        film: f64,
        /// Share of the area that is no cell wall, above 0, at most 1.
        open: f64,
    },
    /// In a medium with a flat front, the reflector concentric with the bead behind a spacing layer.
    Enclosed {
        /// Index of the medium and of the spacing layer, 1 to 2.
        medium: f64,
        /// Radius of the reflector over that of the bead, 1 to 4; [`Beads::focus`] is in focus.
        spacing: f64,
        /// Transmittance of the medium once through along the normal, above 0, at most 1.
        film: f64,
    },
}

impl Mount {
    /// A clear film, three quarters of the area open.
    pub const ENCAPSULATED: Self = Self::Encapsulated { film: 1.0, open: 0.75 };
}

/// What reflects behind a bead: a share of the light, above 0, at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Back {
    /// A mirror of this reflectance.
    Specular(f64),
    /// A white paint or binder on the bead, Lambertian, of this reflectance.
    Diffuse(f64),
}

impl Default for Beads {
    fn default() -> Self {
        Self {
            index: 1.93,
            diameter_um: 60.0,
            spread: 0.1,
            mount: Mount::Exposed,
            back: Back::Specular(0.9),
            packing: 0.65,
            light: Light::White,
        }
    }
}

impl Beads {
    /// The spacing that focuses rays near the axis, m / (2 (m - 1)) for the relative index m: what an
    /// enclosed layer is made for. Below 1, inside the bead, for m above 2.
    #[must_use]
    pub fn focus(index: f64, medium: f64) -> f64 {
        let m = index / medium;
        m / (2.0 * (m - 1.0))
    }

    /// Checks the numbers and does the part of the work that all geometries share.
    ///
    /// # Errors
    /// A number out of its range, or a diffuse back that is not on the bead.
    pub fn prepare(&self) -> Result<PreparedBeads, Error> {
        self.check()?;
        let response = match self.back {
            Back::Specular(_) => Response::Pupils(self.pupils()),
            Back::Diffuse(reflectance) => Response::Diffuse(DiffuseBack::new(
                self.index,
                reflectance,
                0.5 * self.light.mean() * self.diameter_um,
            )),
        };
        Ok(PreparedBeads { beads: *self, response })
    }

    fn check(&self) -> Result<(), Error> {
        let share = |x: f64| x > 0.0 && x <= 1.0;
        let Self { index, diameter_um, spread, packing, .. } = *self;
        within("the bead's index", index, index > 1.0 && index <= 3.0, "(1, 3]")?;
        within("the diameter", diameter_um, (5.0..=1000.0).contains(&diameter_um), "[5, 1000] um")?;
        within("the spread", spread, (0.0..=0.3).contains(&spread), "[0, 0.3] of the diameter")?;
        within("the packing", packing, packing > 0.0 && packing <= 0.9069, "(0, 0.9069]")?;
        let (Back::Specular(reflectance) | Back::Diffuse(reflectance)) = self.back;
        within("the reflectance", reflectance, share(reflectance), "(0, 1]")?;
        match self.mount {
            Mount::Exposed => {}
            Mount::Encapsulated { film, open } => {
                within("the film's transmittance", film, share(film), "(0, 1]")?;
                within("the open share", open, share(open), "(0, 1]")?;
            }
            Mount::Enclosed { medium, spacing, film } => {
                within("the film's transmittance", film, share(film), "(0, 1]")?;
                within("the medium's index", medium, (1.0..=2.0).contains(&medium), "[1, 2]")?;
                within("the bead's index", index, index > medium, "(that of the medium, 3]")?;
                within("the spacing", spacing, (1.0..=4.0).contains(&spacing), "[1, 4] bead radii")?;
                if let Back::Diffuse(_) = self.back {
                    let range = "what is modelled: a diffuse reflector lies on beads in air";
                    within("the spacing of a diffuse reflector", spacing, false, range)?;
                }
            }
        }
        self.light.check()
    }

    /// The index of the medium around the front half.
    fn medium(&self) -> f64 {
        if let Mount::Enclosed { medium, .. } = self.mount { medium } else { 1.0 }
    }

    /// The pupils of all sizes and wavelengths, with their shares: only the number of waves around a bead
    /// matters, so that both are one distribution.
    fn pupils(&self) -> Vec<(Pupil, f64)> {
        let sizes = self.sizes();
        let largest = sizes.iter().map(|(size, _)| *size).fold(0.0, f64::max);
        let relative: Vec<(f64, f64)> = sizes.iter().map(|(size, share)| (size / largest, *share)).collect();
        let nodes = if relative.len() > SIZES { gauss(&relative, SIZES) } else { relative };
        nodes
            .into_iter()
            .map(|(size, share)| (Pupil::new(self, size * largest, MAX_OBSERVATION_DEG.to_radians()), share))
            .collect()
    }

    /// Circumferences in wavelengths in the medium, k R, and their shares.
    fn sizes(&self) -> Vec<(f64, f64)> {
        /// Steps of a tenth of the standard deviation to either side: up to three of it.
        const STEPS: i32 = 30;
        let offsets: Vec<(f64, f64)> = if self.spread > 0.0 {
            (-STEPS..=STEPS).map(|i| 0.1 * f64::from(i)).map(|z| (z, (-0.5 * z * z).exp())).collect()
        } else {
            vec![(0.0, 1.0)]
        };
        let total: f64 = offsets.iter().map(|(_, share)| share).sum();
        let mut sizes = Vec::new();
        for (wave_number, light) in self.light.spectrum() {
            let mean = 0.5 * self.medium() * self.diameter_um * wave_number;
            sizes.extend(
                offsets.iter().map(|(z, share)| (mean * (1.0 + self.spread * z), light * share / total)),
            );
        }
        sizes
    }

    /// Deviation from the retro direction as a sum of c asin(x / r) over pairs (c, r), where x is the
    /// distance of the ray from the axis over the bead's radius.
    fn deviation(&self) -> Vec<(f64, f64)> {
        let m = self.index / self.medium();
        match self.mount {
            Mount::Enclosed { spacing, .. } => vec![(4.0, 1.0), (-4.0, m), (-2.0, spacing)],
            _ => vec![(2.0, 1.0), (-4.0, m)],
        }
    }

    /// The power that comes back along a ray, unpolarised.
    fn transmittance(&self, x: f64) -> f64 {
        // Into the bead and out of it, and with a spacing layer as often at its back.
        let crossings = match self.mount {
            Mount::Enclosed { spacing, .. } if spacing > 1.0 => 4,
            _ => 2,
        };
        let (Back::Specular(reflectance) | Back::Diffuse(reflectance)) = self.back;
        let [s, p] = transmitted(x, self.index / self.medium()).map(|power| power.powi(crossings));
        0.5 * reflectance * (s + p)
    }
}

impl fmt::Display for Beads {
    /// All numbers, without the signs that separate cells.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { index, diameter_um, spread, packing, .. } = *self;
        write!(f, "beads of index {index} and {diameter_um} um (spread {spread}) ")?;
        match self.mount {
            Mount::Exposed => write!(f, "exposed")?,
            Mount::Encapsulated { film, open } => write!(f, "encapsulated (film {film} open {open})")?,
            Mount::Enclosed { medium, spacing, film } => {
                write!(f, "enclosed in {medium} (spacing {spacing:.4} film {film})")?;
            }
        }
        match self.back {
            Back::Specular(reflectance) => write!(f, " mirror {reflectance}")?,
            Back::Diffuse(reflectance) => write!(f, " diffuse {reflectance}")?,
        }
        write!(f, " packing {packing}")
    }
}

/// The exit pupil of a bead of one size in light of one wavelength: amplitudes over the distance from the
/// axis.
#[derive(Clone, Debug)]
struct Pupil {
    /// Distance in waves, k R x, and the amplitude times x dx.
    nodes: Vec<(f64, [f64; 2])>,
    /// (k R)^2 / pi.
    scale: f64,
}

impl Pupil {
    /// `size` is k R in the medium, `reach` the largest observation angle in radians.
    fn new(beads: &Beads, size: f64, reach: f64) -> Self {
        let terms = beads.deviation();
        let sum = |x: f64, f: &dyn Fn(f64, f64) -> f64| terms.iter().map(|&(c, r)| c * f(x, r)).sum::<f64>();
        // The integral of asin(x / r) from 0, which vanishes with x.
        let phase = |x: f64, r: f64| x * (x / r).asin() + (r * r - x * x).max(0.0).sqrt() - r;
        let steepest = (0..=64).map(|i| f64::from(i) / 64.0).fold(0.0_f64, |most, x| {
            most.max(sum(x, &|x, r| (x / r).min(1.0).asin()).abs() * (1.0 - x * x).max(0.0).sqrt())
        });
        // Two points to a wave where the rule below has its widest steps, 2.46 / count of a quarter circle,
        // are 1.23 size (steepest + reach).
        let count = (64.0 + 1.5 * size * (steepest + reach)).ceil();
        let node = |step: u32| {
            let u = (f64::from(step) + 0.5) / count;
            // Leaves both ends slowly, so that the midpoint rule converges at once; its derivative is
            // 630 (u (1 - u))^4.
            let part = u.powi(5) * (126.0 + u * (-420.0 + u * (540.0 + u * (-315.0 + 70.0 * u))));
            let width = FRAC_PI_2 * 630.0 * (u * (1.0 - u)).powi(4) / count;
            let (x, cos) = (FRAC_PI_2 * part).sin_cos();
            let amplitude = beads.transmittance(x).sqrt() * x * cos * width;
            let (sin, cos) = (size * sum(x, &phase)).sin_cos();
            (size * x, [amplitude * cos, amplitude * sin])
        };
        Self { nodes: (0..count as u32).map(node).collect(), scale: size * size / PI }
    }

    /// `R_A` over the packing at an observation angle in the medium, in radians.
    fn coefficient(&self, angle: f64) -> f64 {
        let mut sum = [0.0; 2];
        for &(z, [re, im]) in &self.nodes {
            let j0 = libm::j0(z * angle);
            sum = [sum[0] + re * j0, sum[1] + im * j0];
        }
        let widened = if angle > 0.0 { angle / angle.sin() } else { 1.0 };
        self.scale * widened * (sum[0] * sum[0] + sum[1] * sum[1])
    }
}

/// How light comes back from one bead.
#[derive(Clone, Debug)]
enum Response {
    Pupils(Vec<(Pupil, f64)>),
    Diffuse(DiffuseBack),
}

/// Beads whose numbers were checked. Made by [`Beads::prepare`].
#[derive(Clone, Debug)]
pub struct PreparedBeads {
    beads: Beads,
    response: Response,
}

impl PreparedBeads {
    /// `R_A` in cd/lx/m2; docs/optics.md, sections 1 to 4. Finite, and 0 where source or receiver are below
    /// the surface. Made for observation angles up to 20 and entrance angles up to 85 degrees.
    #[must_use]
    pub fn r_a(&self, geometry: &Geometry) -> f64 {
        if !geometry.is_above_horizon() {
            return 0.0;
        }
        let medium = self.beads.medium();
        let inside = [geometry.wo, geometry.wi].map(|w| refracted(w, medium));
        let angle = Geometry { wo: inside[0], wi: inside[1] }.observation();
        let coefficient = match &self.response {
            Response::Pupils(pupils) => {
                pupils.iter().map(|(pupil, share)| share * pupil.coefficient(angle)).sum()
            }
            Response::Diffuse(back) => back.coefficient(angle),
        };
        self.beads.packing * coefficient * self.reach(geometry)
    }

    /// The share of [`Beads::packing`] that source and receiver reach through whatever is before the beads.
    fn reach(&self, geometry: &Geometry) -> f64 {
        let Geometry { wo, wi } = *geometry;
        let mean_angle = 0.5 * (geometry.entrance() + geometry.viewing());
        let visible = || visible_share(mean_angle, self.beads.packing);
        // Through a film: its surfaces, and its inside, which is longer at a slant.
        let film = |w: Vec3<f64>, index: f64, surfaces: i32, inside: f64| {
            let [s, p] = transmitted(w.x.hypot(w.y), index).map(|power| power.powi(surfaces));
            0.5 * (s + p) * inside.powf(1.0 / refracted(w, index).z)
        };
        match self.beads.mount {
            Mount::Exposed => visible(),
            Mount::Encapsulated { film: inside, open } => {
                open * visible() * film(wi, FILM_INDEX, 2, inside) * film(wo, FILM_INDEX, 2, inside)
            }
            Mount::Enclosed { medium, film: inside, .. } => {
                // Illuminance and solid angle both change at the flat front.
                let front = |w: Vec3<f64>| film(w, medium, 1, inside) * w.z / refracted(w, medium).z;
                front(wi) * front(wo) / (medium * medium)
            }
        }
    }
}

/// A direction after refraction at the sheet's flat front.
fn refracted(w: Vec3<f64>, index: f64) -> Vec3<f64> {
    let (x, y) = (w.x / index, w.y / index);
    Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn exposed(index: f64) -> Beads {
        Beads { index, spread: 0.0, back: Back::Specular(1.0), ..Beads::default() }
    }

    fn enclosed(spacing: f64) -> Beads {
        Beads { mount: Mount::Enclosed { medium: 1.5, spacing, film: 1.0 }, ..exposed(2.2) }
    }

    fn deviation(beads: &Beads, x: f64) -> f64 {
        beads.deviation().iter().map(|&(c, r)| c * (x / r).asin()).sum()
    }

    /// A root of a function between two points where it has different signs.
    fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
        let sign = f(low).signum();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if f(middle).signum() == sign { low = middle } else { high = middle }
        }
        low
    }

    #[test]
    fn the_deviation_has_its_series_and_known_values() {
        for m in [1.5, 1.9, 2.0, 2.2] {
            let x = 1e-2_f64;
            let series = (2.0 - 4.0 / m) * x + (1.0 / 3.0 - 2.0 / (3.0 * m * m * m)) * x.powi(3);
            // Of the fifth order, whose factor is below 0.2.
            assert!((deviation(&exposed(m), x) - series).abs() < 0.2 * x.powi(5), "{m}");
        }
        let x = 1e-2_f64;
        assert!((deviation(&exposed(2.0), x) / (0.25 * x.powi(3)) - 1.0).abs() < x * x, "m = 2 is a cubic");
        // From tracing rays by the vector form of Snell's law in three dimensions, in numpy.
        for (m, degrees) in
            [(1.5, -17.88488), (1.9, -1.03009), (1.93, -0.05892), (2.0, 2.08995), (2.2, 7.45376)]
        {
            assert!((deviation(&exposed(m), 0.5).to_degrees() - degrees).abs() < 5e-6, "{m}");
        }
        assert!((deviation(&enclosed(11.0 / 7.0), 0.5).to_degrees() - 3.16491).abs() < 5e-6);
    }

    #[test]
    fn the_rainbow_and_the_glory_are_where_they_must_be() {
        for (m, caustic, glory) in [
            (1.5, 22.8415, 0.99216),
            (1.9, 1.48790, 0.59327),
            (1.93, 0.85427, 0.50614),
            (1.99, 0.04438, 0.19875),
        ] {
            let beads = exposed(m);
            // The fold, where the deviation is least: cos i = sqrt((m^2 - 1) / 3).
            let fold = (1.0 - (m * m - 1.0) / 3.0_f64).sqrt();
            assert!((deviation(&beads, fold).to_degrees() + caustic).abs() < 6e-5, "{m}");
            for x in [fold - 1e-3, fold + 1e-3] {
                assert!(deviation(&beads, x) > deviation(&beads, fold), "{m}");
            }
            let zero = root(fold, 1.0, |x| deviation(&beads, x));
            assert!((zero - glory).abs() < 6e-6, "{m}: {zero}");
        }
    }

    #[test]
    fn the_focus_of_an_enclosed_bead_has_no_deviation_of_first_order() {
        let focus = Beads::focus(2.2, 1.5);
        assert!((focus - 11.0 / 7.0).abs() < 1e-15);
        assert!(deviation(&enclosed(focus), 1e-4).abs() < 1e-11);
        assert!(deviation(&enclosed(0.97 * focus), 1e-4).abs() > 1e-6);
    }

    #[test]
    fn all_light_that_passes_the_bead_comes_back_somewhere() {
        // Parseval's identity for the Hankel transform. Nothing goes beyond the greatest deviation, 60
        // degrees here, but diffraction.
        let pupil = Pupil::new(&exposed(2.0), 343.0, 1.5);
        let step = 1e-3;
        let ring = |i: u32| (f64::from(i) + 0.5) * step;
        let back: f64 = (0..1500).map(ring).map(|a| pupil.coefficient(a) * TAU * a.sin() * step).sum();
        let passed: f64 = (0..100_000)
            .map(|i| (f64::from(i) + 0.5) / 1e5)
            .map(|x| exposed(2.0).transmittance(x) * 2.0 * x / 1e5)
            .sum();
        assert!((back / passed - 1.0).abs() < 1e-3, "{back} {passed}");
        // Computed once more in numpy: the sum over the aperture.
        for (m, expected) in [(1.5, 0.84061), (1.9, 0.74957), (1.93, 0.74328), (2.2, 0.68962)] {
            let sum = (0..100_000).map(|i| (f64::from(i) + 0.5) / 1e5);
            let sum: f64 = sum.map(|x| exposed(m).transmittance(x) * 2.0 * x / 1e5).sum();
            assert!((sum - expected).abs() < 1e-5, "{m}: {sum}");
        }
    }

    /// The sum over the rays of an observation angle, x T / (pi sin alpha |d delta / dx|): no diffraction.
    fn of_rays(beads: &Beads, alpha: f64) -> f64 {
        const STEPS: usize = 20_000;
        let mut sum = 0.0;
        for (i, sign) in (0..STEPS).flat_map(|i| [(i, -1.0), (i, 1.0)]) {
            let [low, high] = [i, i + 1].map(|i| i as f64 / STEPS as f64);
            let off = |x: f64| deviation(beads, x) - sign * alpha;
            if off(low) * off(high) < 0.0 {
                let x = root(low, high, off);
                let slope = (off(x + 1e-7) - off(x - 1e-7)) / 2e-7;
                sum += x * beads.transmittance(x) / (PI * alpha.sin() * slope.abs());
            }
        }
        sum
    }

    #[test]
    fn rays_alone_have_their_known_coefficients() {
        let alpha = 0.2_f64.to_radians();
        for (m, expected) in [(2.0, 381.89), (1.93, 493.17), (1.9, 352.72), (1.5, 4.5829)] {
            let found = of_rays(&exposed(m), alpha);
            assert!((found / expected - 1.0).abs() < 1e-4, "{m}: {found}");
        }
    }

    #[test]
    fn beads_of_index_two_fall_as_a_power() {
        // T(0) 4 / (3 pi) 4^(-1/3) alpha^(-4/3) for small angles.
        let law = |a: f64| {
            (8.0_f64 / 9.0).powi(2) * 4.0 / (3.0 * PI) * 4.0_f64.powf(-1.0 / 3.0) * a.powf(-4.0 / 3.0)
        };
        for (degrees, ratio) in [(1e-3_f64, 0.9987), (0.01, 0.994), (0.1, 0.973)] {
            let a = degrees.to_radians();
            let found = of_rays(&exposed(2.0), a) / law(a);
            assert!((found - ratio).abs() < 6e-4, "{degrees}: {found}");
        }
        // A bead of 50 mm has the same: what diffraction is left is of the order of a wave over its phase, 1
        // / 90.
        let a = 0.1_f64.to_radians();
        let pupil = Pupil::new(&exposed(2.0), 3e5, 0.01);
        assert!(
            (pupil.coefficient(a) / law(a) / 0.973 - 1.0).abs() < 0.012,
            "{}",
            pupil.coefficient(a) / law(a)
        );
    }

    #[test]
    fn the_pupil_is_close_to_the_exact_sphere() {
        // The term of the Debye series (van de Hulst, "Light Scattering by Small Particles", section 12.2)
        // that was reflected once, by a perfect mirror in place of Fresnel's coefficient: vector partial
        // waves with scipy's spherical Bessel functions. 30 um radius, 550 nm; the pupil is scalar and its
        // edge is sharp.
        for (m, values) in [
            (
                1.9,
                [
                    (0.0, 892.882),
                    (0.2, 706.988),
                    (0.5, 166.159),
                    (1.0, 158.735),
                    (2.0, 26.6867),
                    (5.0, 2.71462),
                ],
            ),
            (
                1.93,
                [
                    (0.0, 1106.33),
                    (0.2, 949.997),
                    (0.5, 391.024),
                    (1.0, 8.36726),
                    (2.0, 4.74458),
                    (5.0, 3.01617),
                ],
            ),
            (
                2.0,
                [
                    (0.0, 253.905),
                    (0.2, 238.707),
                    (0.5, 172.643),
                    (1.0, 57.4736),
                    (2.0, 15.1055),
                    (5.0, 3.68773),
                ],
            ),
        ] {
            let pupil = Pupil::new(&exposed(m), TAU * 30.0 / 0.55, 0.1);
            for (degrees, exact) in values {
                let found = pupil.coefficient(f64::to_radians(degrees));
                assert!((found / exact - 1.0).abs() < 0.03, "{m} {degrees}: {found} {exact}");
            }
        }
    }

    #[test]
    fn the_pupil_is_close_to_its_paraxial_form() {
        // numpy, with the integral of sin(deviation) for the phase, which is that for small angles only.
        for (m, degrees, expected) in [
            (1.93, 0.0_f64, 1126.385),
            (1.93, 0.2, 962.734),
            (1.93, 0.5, 388.467),
            (2.0, 0.2, 240.428),
            (1.9, 1.0, 159.640),
        ] {
            let found = Pupil::new(&exposed(m), TAU * 30.0 / 0.55, 0.1).coefficient(degrees.to_radians());
            assert!((found / expected - 1.0).abs() < 0.012, "{m} {degrees}: {found}");
        }
    }
}
