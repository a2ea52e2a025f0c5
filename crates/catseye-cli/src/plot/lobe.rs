//! The lobes' shape: f cos in the plane of incidence.

use std::ops::RangeInclusive;

use anyhow::bail;
use catseye::{AnyLobe, DIRAC_ROUGHNESS, Lobe as _, Model, ParamError, Params, Vec3, width};
use plotters::prelude::DrawingBackend;

use super::axes::{Axes as Frame, roughness_label, ticks, unbounded};
use super::canvas::{Canvas, INK, Lettering, MUTED};
use super::curves::{Curve, Panel, style, without_width};
use super::figure::Figure;
use super::polar;

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

const PANEL_WIDTH: f64 = 430.0;
/// What title and legend need.
const LEAST_WIDTH: f64 = 1060.0;
const MARGIN: f64 = 24.0;
const TOP: f64 = 84.0;
const BOTTOM: f64 = 72.0;

/// The shape of the diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Axes {
    /// The distance from the centre is the value.
    Polar,
    /// The value over the angle.
    Cartesian,
}

/// What to plot.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    pub(crate) roughness: [f64; 2],
    pub(crate) theta_deg: Vec<f64>,
    pub(crate) phi_deg: f64,
    pub(crate) models: Vec<Model>,
    /// The shape of the diagram; `None` chooses by the lobe's width.
    pub(crate) axes: Option<Axes>,
}

impl Request {
    /// The angle from the retro direction, in degrees, within which all but nothing of the lobe lies.
    fn reach_deg(&self) -> f64 {
        // The lobe itself is no narrower either.
        let [m_u, m_v] = self.roughness.map(|roughness| width(roughness.max(DIRAC_ROUGHNESS)));
        let (sin, cos) = self.phi_deg.to_radians().sin_cos();
        let in_plane = 1.0 / (cos / m_u).hypot(sin / m_v);
        REACH * in_plane.to_degrees()
    }

    fn axes(&self) -> Axes {
        let suitable = if self.reach_deg() < NEEDLE { Axes::Cartesian } else { Axes::Polar };
        self.axes.unwrap_or(suitable)
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
        let params = Params::anisotropic(request.roughness[0], request.roughness[1]);
        let lobes = request.models.iter().map(|&model| Ok((model, AnyLobe::new(model, &params)?)));
        let lobes = lobes.collect::<Result<Vec<_>, ParamError>>()?;
        if let Some((model, _)) = lobes.iter().find(|(_, lobe)| lobe.is_dirac()) {
            bail!(without_width(&roughness_label(request.roughness), *model));
        }
        let panels: Vec<_> =
            request.theta_deg.iter().map(|&theta_deg| panel(&request, &lobes, theta_deg)).collect();
        let values = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.values);
        let greatest = values.map(|&(_, value)| value).fold(LEAST_SCALE, f64::max);
        Ok(Self { request, panels, greatest })
    }

    fn title(&self) -> String {
        let [u, v] = self.request.roughness.map(unbounded);
        let across = if u == v { String::new() } else { format!(" along and {v} across the tangent") };
        let plane = match self.request.phi_deg {
            0.0 => String::new(),
            phi => format!(", plane of incidence {phi}° from the tangent"),
        };
        format!("Light sent back by the lobe of roughness {u}{across}{plane}")
    }
}

fn panel(request: &Request, lobes: &[(Model, AnyLobe<f64>)], theta_deg: f64) -> Panel {
    let phi = request.phi_deg.to_radians();
    let wo = Vec3::from_angles(theta_deg.to_radians(), phi);
    let angles = angles(theta_deg, request.reach_deg());
    let curve = |&(model, lobe): &(Model, AnyLobe<f64>)| {
        let value = |&angle: &f64| {
            let wi = Vec3::from_angles(angle.to_radians(), phi);
            (angle, lobe.eval(wo, wi)[0] * wi.z.max(0.0))
        };
        Curve { model, values: angles.iter().map(value).collect() }
    };
    // The first model's curve is drawn last, on top.
    Panel { theta_deg, curves: lobes.iter().rev().map(curve).collect() }
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
    fn size(&self) -> (u32, u32) {
        let width = (2.0 * MARGIN + self.panels.len() as f64 * PANEL_WIDTH).max(LEAST_WIDTH);
        (width as u32, (TOP + polar::HEIGHT + BOTTOM) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let subtitle = "f(\u{3c9}o, \u{3c9}i) cos \u{3b8}i in 1/sr over the outgoing angle \u{3b8}i, in the plane of incidence; \
                        all panels to one scale";
        canvas.text(&self.title(), (MARGIN, 32.0), Lettering::left(24.0, INK))?;
        canvas.text(subtitle, (MARGIN, 62.0), Lettering::left(15.0, MUTED))?;
        for (i, panel) in self.panels.iter().enumerate() {
            let indent = 0.5 * (f64::from(self.size().0) - PANEL_WIDTH * self.panels.len() as f64);
            let left = indent + PANEL_WIDTH * i as f64;
            match self.request.axes() {
                Axes::Polar => polar::draw(canvas, panel, left + PANEL_WIDTH / 2.0, TOP, self.greatest)?,
                Axes::Cartesian => self.draw_cartesian(canvas, panel, left)?,
            }
        }
        self.draw_legend(canvas)
    }
}

impl LobeFigure {
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
        let (x, x_ticks) = self.angle_range(panel.theta_deg);
        let frame = Frame {
            origin: (left + 52.0, TOP + 40.0),
            size: (PANEL_WIDTH - 72.0, polar::HEIGHT - 96.0),
            x: x.clone(),
            y: 0.0..=top,
        };
        let mut y_ticks = ticks(top, 5.0);
        y_ticks.insert(0, 0.0);
        let title = format!("light at {}°", panel.theta_deg);
        frame.draw(canvas, [&x_ticks, &y_ticks], ["outgoing angle", &title])?;
        for curve in &panel.curves {
            let (color, width) = curve.style();
            let shown = curve.values.iter().filter(|(angle, _)| x.contains(angle));
            let points: Vec<_> = shown.map(|&value| frame.place(value)).collect();
            canvas.line(&points, color, width)?;
        }
        Ok(())
    }

    /// The angles that a diagram shows, and those that it names.
    fn angle_range(&self, theta_deg: f64) -> (RangeInclusive<f64>, Vec<f64>) {
        let reach = self.request.reach_deg();
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

    fn draw_legend<DB: DrawingBackend>(&self, canvas: &Canvas<'_, DB>) -> anyhow::Result<()>
    where
        DB::ErrorType: 'static,
    {
        let mut x = MARGIN;
        let y = f64::from(self.size().1) - 28.0;
        for &model in &self.request.models {
            let (color, width) = style(model);
            canvas.line(&[(x, y), (x + 34.0, y)], color, width)?;
            canvas.text(legend(model), (x + 44.0, y), Lettering::left(15.0, INK))?;
            x += 44.0 + canvas.width(legend(model), 15.0)? + 32.0;
        }
        Ok(())
    }
}
