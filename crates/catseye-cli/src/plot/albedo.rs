//! The albedo of single scattering over the angle of incidence.

use std::f64::consts::FRAC_PI_2;

use catseye::{Model, ParamError, Params, Vec3};
use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, roughness_label};
use super::canvas::{Canvas, GRID, INK, Lettering, MUTED};
use super::curves::{LABEL_STEP, shade, spread};
use super::figure::Figure;

/// The roughnesses that are shown if none are asked for.
const ROUGHNESSES: [f64; 9] = [0.05, 0.15, 0.3, 0.5, 0.7, 1.0, 1.5, 3.0, f64::INFINITY];

/// Points of a curve.
const STEPS: u32 = 90;
const SIZE: (u32, u32) = (960, 640);

/// The computed curves.
#[derive(Debug)]
pub(crate) struct AlbedoFigure {
    model: Model,
    curves: Vec<Curve>,
}

#[derive(Debug)]
struct Curve {
    roughness: [f64; 2],
    color: RGBColor,
    /// Angle of incidence in degrees, albedo.
    values: Vec<(f64, f64)>,
}

impl AlbedoFigure {
    /// Computes the curves, over angles in the plane of the tangent; without roughnesses those of a range.
    pub(crate) fn new(model: Model, roughnesses: &[[f64; 2]]) -> anyhow::Result<Self> {
        let all = ROUGHNESSES.map(|roughness| [roughness; 2]);
        let roughnesses = if roughnesses.is_empty() { &all } else { roughnesses };
        let mut curves = Vec::new();
        for (i, &roughness) in roughnesses.iter().enumerate() {
            let value = |step: u32| {
                // The horizon itself belongs to neither side.
                let theta = (f64::from(step) / f64::from(STEPS) * FRAC_PI_2).min(FRAC_PI_2 - 1e-6);
                let params = Params::anisotropic(roughness[0], roughness[1]);
                let albedo = model.exact_albedo(&params, Vec3::from_angles(theta, 0.0))?;
                Ok((theta.to_degrees(), albedo[0]))
            };
            let share = i as f64 / (roughnesses.len().max(2) - 1) as f64;
            let values = (0..=STEPS).map(value).collect::<Result<_, ParamError>>()?;
            curves.push(Curve { roughness, color: shade(share), values });
        }
        Ok(Self { model, curves })
    }
}

impl Figure for AlbedoFigure {
    fn title(&self) -> String {
        format!("Share of the light that single scattering sends back: {}", self.model.name())
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let subtitle = match self.model {
            Model::Reciprocal => "multiscatter_tint 0, tint 1; light in the plane of the tangent",
            Model::Edwards => "tint 1; light in the plane of the tangent",
            Model::BackVector => {
                "tint 1; light in the plane of the tangent; GGX alpha of the same peak at 0°"
            }
        };
        canvas.text(&self.title(), (24.0, 32.0), Lettering::left(22.0, INK))?;
        canvas.text(subtitle, (24.0, 60.0), Lettering::left(15.0, MUTED))?;
        let frame = Axes { origin: (64.0, 122.0), size: (740.0, 440.0), x: 0.0..=90.0, y: 0.0..=1.0 };
        let x_ticks: Vec<f64> = (0..=6).map(|i| 15.0 * f64::from(i)).collect();
        let y_ticks: Vec<f64> = (0..=5).map(|i| 0.2 * f64::from(i)).collect();
        frame.draw(canvas, [&x_ticks, &y_ticks], ["angle of incidence", "directional albedo"])?;
        for curve in &self.curves {
            let points: Vec<_> = curve.values.iter().map(|&value| frame.place(value)).collect();
            canvas.line(&points, curve.color, 2.5)?;
        }
        self.draw_labels(canvas, &frame)
    }
}

impl AlbedoFigure {
    /// The roughness beside each curve's end, moved apart where curves end close together.
    fn draw_labels<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>, frame: &Axes) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let mut ends: Vec<_> = self
            .curves
            .iter()
            .filter_map(|curve| Some((curve, frame.place(*curve.values.last()?))))
            .collect();
        // Whole pixels: curves that end in one point stay in the order of their roughness.
        ends.sort_by(|(_, a), (_, b)| a.1.round().total_cmp(&b.1.round()));
        let heights =
            spread(&ends.iter().map(|(_, end)| end.1).collect::<Vec<_>>(), LABEL_STEP, frame.origin.1);
        let right = frame.origin.0 + frame.size.0;
        canvas.text("roughness", (right + 34.0, frame.origin.1 - 22.0), Lettering::left(15.0, INK))?;
        for ((curve, end), y) in ends.into_iter().zip(heights) {
            canvas.line(&[end, (right + 28.0, y)], GRID, 1.0)?;
            let label = roughness_label(curve.roughness);
            canvas.text(&label, (right + 34.0, y), Lettering::left(15.0, curve.color))?;
        }
        Ok(())
    }
}
