//! Beads and cubes beside the lobes that are fitted to them.

use catseye::Model;
use catseye_photometry::fit::{Aim, FitOptions, Observation, fit};
use catseye_photometry::optics::{Angles, Beads, Cubes, Mount};
use catseye_photometry::{Geometry, Goniometer, Quantity};
use plotters::prelude::{DrawingBackend, RGBColor};

use super::axes::{Axes, signed};
use super::canvas::{Canvas, INK, Lettering, MUTED};
use super::chart::log_ticks;
use super::curves::style;
use super::figure::Figure;

const SIZE: (u32, u32) = (1140, 560);
/// Width of a panel, and from one to the next.
const PANEL: f64 = 296.0;
const STEP: f64 = 368.0;
/// Points of a curve.
const STEPS: u32 = 150;
/// Observation angle at the axis' end, and the entrance angle of all curves, in degrees.
const END_DEG: f64 = 2.0;
const ENTRANCE_DEG: f64 = 5.0;
/// Decimal logarithms of the values at the axis' ends.
const DECADES: [f64; 2] = [0.0, 3.301_03];
const COMPUTED: RGBColor = RGBColor(0xb4, 0xb9, 0xbf);

/// `R_A` in cd/lx/m2.
type Coefficient<'a> = Box<dyn Fn(&Geometry) -> f64 + Sync + 'a>;

/// Colour, width, name, and observation angles in degrees with their values.
type Curve = (RGBColor, f64, String, Vec<(f64, f64)>);

/// The curves of a reflector and of its fits.
#[derive(Debug)]
struct Panel {
    title: &'static str,
    curves: Vec<Curve>,
}

/// The computed curves.
#[derive(Debug)]
pub(crate) struct OpticsFigure(Vec<Panel>);

impl OpticsFigure {
    /// Computes everything, and fits both lobes to the values at the usual angles.
    pub(crate) fn new() -> anyhow::Result<Self> {
        let focus = Mount::Enclosed { medium: 1.5, spacing: Beads::focus(2.2, 1.5), film: 1.0 };
        let film = Beads { index: 2.2, mount: focus, ..Beads::default() }.prepare()?;
        let tape = Beads { index: 1.9, mount: Mount::ENCAPSULATED, ..Beads::default() }.prepare()?;
        let prisms = Cubes::default().prepare()?;
        let reflectors: [(_, Coefficient<'_>); 3] = [
            ("enclosed beads, 2.2 in 1.5, in focus", Box::new(|geometry| film.r_a(geometry))),
            ("encapsulated beads, 1.9, film", Box::new(|geometry| tape.r_a(geometry))),
            ("cubes, 1.586, 150 µm, errors 8′", Box::new(|geometry| prisms.r_a(geometry))),
        ];
        let panels = reflectors.into_iter().map(|(title, r_a)| panel(title, r_a.as_ref()));
        Ok(Self(panels.collect::<anyhow::Result<_>>()?))
    }
}

/// One reflector and its fits.
fn panel(title: &'static str, r_a: &(dyn Fn(&Geometry) -> f64 + Sync)) -> anyhow::Result<Panel> {
    let table = Angles::default().table(title, None, r_a)?.table;
    let observations: Vec<Observation> = table
        .rows()
        .iter()
        .map(|row| Observation::from_row(row, Aim::Equal, None))
        .collect::<Result<_, _>>()?;
    let mut curves = vec![(COMPUTED, 7.0, "computed".to_owned(), curve(r_a))];
    for (model, name) in [(Model::Reciprocal, "our lobes"), (Model::BackVector, "back vector")] {
        let fitted = fit(
            &observations,
            &FitOptions { model, lobes: Some(2), isotropic: true, ..FitOptions::default() },
        )?;
        let sheeting = fitted.sheeting.prepare()?;
        let of_fit = |geometry: &Geometry| {
            let f = sheeting.eval(geometry.wo, geometry.wi);
            Quantity::RetroReflectionCoefficient.of_brdf(f, geometry).unwrap_or_default()
        };
        let (color, width) = style(model);
        let rms = 100.0 * fitted.rms.exp_m1();
        curves.push((color, width, format!("{name}: rms {rms:.0} %"), curve(&of_fit)));
    }
    Ok(Panel { title, curves })
}

/// Values over the observation angle.
fn curve(r_a: &dyn Fn(&Geometry) -> f64) -> Vec<(f64, f64)> {
    let value = |step: u32| {
        let observation = END_DEG * f64::from(step) / f64::from(STEPS);
        (observation, r_a(&Geometry::from(Goniometer::from_degrees(observation, ENTRANCE_DEG, 0.0, 0.0))))
    };
    (0..=STEPS).map(value).collect()
}

impl Figure for OpticsFigure {
    fn title(&self) -> String {
        "R_A of beads and cubes, and of the lobes fitted to them".to_owned()
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let subtitle = "entrance angle 5°, illuminant A; two lobes fitted to 32 values at 0.1° to 2° and entrance angles of 5° to 40°";
        canvas.text(&self.title(), (24.0, 32.0), Lettering::left(22.0, INK))?;
        canvas.text(subtitle, (24.0, 60.0), Lettering::left(15.0, MUTED))?;
        let [bottom, top] = DECADES;
        for (i, panel) in self.0.iter().enumerate() {
            let origin = (66.0 + STEP * i as f64, 150.0);
            let frame = Axes { origin, size: (PANEL, 330.0), x: 0.0..=END_DEG, y: bottom..=top };
            let titles = ["observation angle", "R_A in cd/lx/m²"];
            let x_ticks = [0.0, 0.5, 1.0, 1.5, 2.0].map(|angle| (angle, format!("{}°", signed(angle))));
            frame.draw_labelled(canvas, &x_ticks, &log_ticks(bottom, top), titles)?;
            canvas.text(panel.title, (origin.0 - 30.0, 98.0), Lettering::left(16.0, INK))?;
            for (j, (color, width, name, values)) in panel.curves.iter().enumerate() {
                let points: Vec<_> =
                    values.iter().map(|&(x, r_a)| frame.place((x, r_a.log10().max(bottom)))).collect();
                canvas.line(&points, *color, *width)?;
                let at = (origin.0 + PANEL - 8.0, 166.0 + 21.0 * j as f64);
                let ink = if j == 0 { MUTED } else { *color };
                canvas.text(name, at, Lettering::right(15.0, ink))?;
            }
        }
        Ok(())
    }
}
