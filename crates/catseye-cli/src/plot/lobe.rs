//! The lobes' shape: f cos in the plane of incidence.

use std::ops::RangeInclusive;

use anyhow::bail;
use catseye::{AnyLobe, DIRAC_ROUGHNESS, Lobe as _, Model, ParamError, Params, Vec3, width};
use plotters::prelude::DrawingBackend;

use super::axes::{Axes as Frame, degrees, roughness_label, ticks};
use super::canvas::{Canvas, INK, Lettering, MUTED};
use super::curves::{Curve, Panel, style, without_width};
use super::figure::Figure;
use super::polar::{self, Polar};

/// Steps of a curve between the horizons.
const STEPS: i32 = 1440;
/// Steps from the retro direction to either end of the lobe's reach.
const REACH_STEPS: i32 = 400;
/// A lobe's reach in units of its width: at 8 the value has fallen to exp(-16) of its peak.
const REACH: f64 = 8.0;
/// Degrees of reach below which a diagram over the angle shows the lobe's surroundings only.
const ZOOM: f64 = 60.0;
/// Degrees of reach below which a polar diagram is a needle.
const NEEDLE: f64 = 12.0;

/// The diagram's greatest value in 1/sr where there is nothing to see.
const LEAST_SCALE: f64 = 1e-6;

/// Decades below the peak that a logarithmic diagram shows.
const DECADES: i32 = 8;
/// What a logarithmic diagram shows, in units of the lobe's reach.
const LOG_REACH: f64 = 1.5;

/// Width that the panels share, where they don't get too narrow or too wide.
const PANELS_WIDTH: f64 = 876.0;
const LEAST_PANEL: f64 = 290.0;
const GREATEST_PANEL: f64 = 438.0;
const MARGIN: f64 = 20.0;
const TOP: f64 = 76.0;
/// Height of a line of the legend.
const LINE: f64 = 22.0;

/// The shape of the diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Axes {
    /// The distance from the centre is the value.
    Polar,
    /// The value over the angle.
    Cartesian,
    /// The share of the peak over the angle, on a logarithmic scale: shows tails.
    Log,
}

/// What to plot: a panel for each pair of roughness and direction.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// Along and across the tangent.
    pub(crate) roughness: Vec<[f64; 2]>,
    pub(crate) theta_deg: Vec<f64>,
    pub(crate) phi_deg: f64,
    pub(crate) models: Vec<Model>,
    /// The shape of the diagram; `None` chooses by the lobe's width.
    pub(crate) axes: Option<Axes>,
}

impl Request {
    /// The angle from the retro direction, in degrees, within which all but nothing of the lobe lies.
    fn reach_deg(&self, roughness: [f64; 2]) -> f64 {
        // The lobe itself is no narrower either.
        let [m_u, m_v] = roughness.map(|roughness| width(roughness.max(DIRAC_ROUGHNESS)));
        let (sin, cos) = self.phi_deg.to_radians().sin_cos();
        let in_plane = 1.0 / (cos / m_u).hypot(sin / m_v);
        let share = if self.axes == Some(Axes::Log) { LOG_REACH } else { 1.0 };
        share * REACH * in_plane.to_degrees()
    }

    fn axes(&self) -> Axes {
        let narrow = self.roughness.iter().any(|&roughness| self.reach_deg(roughness) < NEEDLE);
        self.axes.unwrap_or(if narrow { Axes::Cartesian } else { Axes::Polar })
    }

    fn panels(&self) -> f64 {
        (self.roughness.len() * self.theta_deg.len()) as f64
    }
}

/// The computed curves.
#[derive(Debug)]
pub(crate) struct LobeFigure {
    request: Request,
    panels: Vec<Panel>,
    greatest: f64,
}

fn legend(model: Model) -> &'static str {
    match model {
        Model::Reciprocal => "reciprocal: the proposal's lobe",
        Model::Edwards => "edwards: the paper's lobe",
        Model::BackVector => "back-vector: MaterialX 1.39.5, GGX alpha of the same peak at 0°",
    }
}

impl LobeFigure {
    /// Computes the curves.
    pub(crate) fn new(request: Request) -> anyhow::Result<Self> {
        let mut panels = Vec::new();
        for &roughness in &request.roughness {
            let params = Params::anisotropic(roughness[0], roughness[1]);
            let lobes = request.models.iter().map(|&model| Ok((model, AnyLobe::new(model, &params)?)));
            let lobes = lobes.collect::<Result<Vec<_>, ParamError>>()?;
            if let Some((model, _)) = lobes.iter().find(|(_, lobe)| lobe.is_dirac()) {
                bail!(without_width(&roughness_label(roughness), *model));
            }
            let reach_deg = request.reach_deg(roughness);
            for &theta_deg in &request.theta_deg {
                let title = match request.roughness.len() {
                    1 => format!("light at {theta_deg}°"),
                    _ => format!("roughness {}, light at {theta_deg}°", roughness_label(roughness)),
                };
                let curves = curves(&request, &lobes, theta_deg, reach_deg);
                panels.push(Panel { title, theta_deg, reach_deg, curves });
            }
        }
        let greatest = panels.iter().map(Panel::greatest).fold(LEAST_SCALE, f64::max);
        Ok(Self { request, panels, greatest })
    }

    fn panel_width(&self) -> f64 {
        (PANELS_WIDTH / self.request.panels()).clamp(LEAST_PANEL, GREATEST_PANEL)
    }

    fn subtitle(&self) -> String {
        let plane = match self.request.phi_deg {
            0.0 => "in the plane of incidence".to_owned(),
            phi => format!("in a plane of incidence {phi}° from the tangent"),
        };
        match self.request.axes() {
            Axes::Log => format!("f(\u{3c9}o, \u{3c9}i) cos \u{3b8}i relative to its peak, {plane}"),
            Axes::Polar | Axes::Cartesian => format!(
                "f(\u{3c9}o, \u{3c9}i) cos \u{3b8}i in 1/sr over the outgoing angle, {plane}; all panels to \
                 one scale"
            ),
        }
    }
}

fn curves(request: &Request, lobes: &[(Model, AnyLobe<f64>)], theta_deg: f64, reach_deg: f64) -> Vec<Curve> {
    let phi = request.phi_deg.to_radians();
    let wo = Vec3::from_angles(theta_deg.to_radians(), phi);
    let angles = angles(theta_deg, reach_deg);
    let curve = |&(model, lobe): &(Model, AnyLobe<f64>)| {
        let value = |&angle: &f64| {
            let wi = Vec3::from_angles(angle.to_radians(), phi);
            (angle, lobe.eval(wo, wi)[0] * wi.z.max(0.0))
        };
        Curve { model, values: angles.iter().map(value).collect() }
    };
    // The first model's curve is drawn last, on top.
    lobes.iter().rev().map(curve).collect()
}

/// Angles of a curve in degrees: everywhere, and closer around the retro direction.
fn angles(theta_deg: f64, reach_deg: f64) -> Vec<f64> {
    // The horizons themselves belong to neither side.
    let even = (1..STEPS).map(|i| 180.0 * f64::from(i) / f64::from(STEPS) - 90.0);
    let near =
        (-REACH_STEPS..=REACH_STEPS).map(|i| theta_deg + reach_deg * f64::from(i) / f64::from(REACH_STEPS));
    let mut all: Vec<f64> = even.chain(near.filter(|angle| angle.abs() < 90.0)).collect();
    all.sort_by(f64::total_cmp);
    all
}

impl Figure for LobeFigure {
    fn title(&self) -> String {
        let all: Vec<String> =
            self.request.roughness.iter().map(|&roughness| roughness_label(roughness)).collect();
        let (lobes, all) = (if all.len() == 1 { "the lobe" } else { "the lobes" }, all.join(" and "));
        format!("Light sent back by {lobes} of roughness {all}")
    }

    fn size(&self) -> (u32, u32) {
        let width = 2.0 * MARGIN + (self.request.panels() * self.panel_width()).max(PANELS_WIDTH);
        let legend = LINE * self.request.models.len() as f64 + LINE / 2.0;
        (width as u32, (TOP + polar::height(self.panel_width()) + legend) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        canvas.text(&self.title(), (MARGIN, 28.0), Lettering::left(20.0, INK))?;
        canvas.text(&self.subtitle(), (MARGIN, 56.0), Lettering::left(14.0, MUTED))?;
        let width = self.panel_width();
        let indent = 0.5 * (f64::from(self.size().0) - self.request.panels() * width);
        for (i, panel) in self.panels.iter().enumerate() {
            let left = indent + width * i as f64;
            match self.request.axes() {
                Axes::Polar => self.draw_polar(canvas, panel, left)?,
                Axes::Cartesian => self.draw_cartesian(canvas, panel, left)?,
                Axes::Log => self.draw_log(canvas, panel, left)?,
            }
        }
        self.draw_legend(canvas)
    }
}

impl LobeFigure {
    fn frame(&self, left: f64, x: RangeInclusive<f64>, y: RangeInclusive<f64>) -> Frame {
        let width = self.panel_width();
        let size = (width - 72.0, polar::height(width) - 96.0);
        Frame { origin: (left + 56.0, TOP + 40.0), size, x, y }
    }

    fn draw_polar<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        panel: &Panel,
        left: f64,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let frame = Polar::new([left, TOP], self.panel_width(), self.greatest);
        frame.draw(canvas, panel.theta_deg, &panel.title)?;
        panel.draw_curves(canvas, |at| Some(frame.place(at)))?;
        frame.draw_light(canvas, panel.theta_deg)
    }

    fn draw_cartesian<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        panel: &Panel,
        left: f64,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let top = self.greatest * 1.05;
        let (x, x_ticks) = panel.angle_range();
        let frame = self.frame(left, x.clone(), 0.0..=top);
        let mut y_ticks = ticks(top, 5.0);
        y_ticks.insert(0, 0.0);
        frame.draw(canvas, [&x_ticks, &y_ticks], ["outgoing angle", &panel.title])?;
        panel.draw_curves(canvas, |at| x.contains(&at.0).then(|| frame.place(at)))
    }

    fn draw_log<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        panel: &Panel,
        left: f64,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let bottom = -f64::from(DECADES);
        let (x, x_ticks) = panel.angle_range();
        let frame = self.frame(left, x.clone(), bottom..=0.0);
        let label = |decade: i32| (-f64::from(decade), power_of_ten(-decade));
        let y_ticks: Vec<_> = (0..=DECADES).step_by(2).map(label).collect();
        frame.draw_labelled(canvas, &degrees(&x_ticks), &y_ticks, ["outgoing angle", &panel.title])?;
        let peak = panel.greatest();
        panel.draw_curves(canvas, |(angle, value)| {
            let log = (value / peak).log10();
            (x.contains(&angle) && log >= bottom).then(|| frame.place((angle, log)))
        })
    }

    fn draw_legend<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let top = TOP + polar::height(self.panel_width());
        for (i, &model) in self.request.models.iter().enumerate() {
            let y = top + LINE * (i as f64 + 0.5);
            let (color, width) = style(model);
            canvas.line(&[(MARGIN, y), (MARGIN + 34.0, y)], color, width)?;
            canvas.text(legend(model), (MARGIN + 44.0, y), Lettering::left(14.0, INK))?;
        }
        Ok(())
    }
}

impl Panel {
    /// Draws the curves through where `place` puts their values; what it puts nowhere is left out.
    fn draw_curves<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<'_, DB>,
        place: impl Fn((f64, f64)) -> Option<(f64, f64)>,
    ) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        for curve in &self.curves {
            let (color, width) = curve.style();
            let points: Vec<_> = curve.values.iter().filter_map(|&value| place(value)).collect();
            canvas.line(&points, color, width)?;
        }
        Ok(())
    }

    fn greatest(&self) -> f64 {
        self.curves.iter().flat_map(|curve| &curve.values).map(|&(_, value)| value).fold(0.0, f64::max)
    }

    /// The angles that a diagram shows, and those that it names.
    fn angle_range(&self) -> (RangeInclusive<f64>, Vec<f64>) {
        let (theta_deg, reach) = (self.theta_deg, self.reach_deg);
        if reach >= ZOOM {
            return (-90.0..=90.0, (-3..=3).map(|i| 30.0 * f64::from(i)).collect());
        }
        // Not beyond the horizon, but as wide as the other panels.
        let center = theta_deg.min(90.0 - reach);
        let range = center - reach..=center + reach;
        let step = ticks(reach, 2.0)[0];
        let all = (-8..=8).map(|i| theta_deg + step * f64::from(i));
        let named = all.filter(|angle| range.contains(angle)).collect();
        (range, named)
    }
}

/// Ten to a power, in print.
fn power_of_ten(exponent: i32) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}', '\u{2078}',
        '\u{2079}',
    ];
    if exponent == 0 {
        return "1".to_owned();
    }
    let exponent = exponent.to_string();
    let raised = exponent.chars().map(|c| c.to_digit(10).map_or('\u{207b}', |d| DIGITS[d as usize]));
    std::iter::once("10".to_owned()).chain(raised.map(String::from)).collect()
}
