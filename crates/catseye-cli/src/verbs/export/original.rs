//! What is exported: a material, or the one that is fitted to a table.

use std::f64::consts::PI;
use std::path::Path;

use anyhow::{Context as _, bail};
use catseye::Model;
use catseye_materialx::{Document, Material};
use catseye_photometry::brdf::Cosine;
use catseye_photometry::export::{Coat, Colours};
use catseye_photometry::fit::{Aim, FitOptions, Observation, fit};
use catseye_photometry::{
    Apertures, Colour, Geometry, Goniometer, MaterialText, Quantity, Row, Table, luminance, to_mtlx,
};

use super::parts;
use super::{Args, Target};
use crate::failure::Usage;
use crate::instrument::Channel;
use crate::instrument::goniometer::Photometer;
use crate::instrument::table::{ENTRANCES_DEG, OBSERVATIONS_DEG, grid};
use crate::verbs::fit::subject::Subject;

/// Observation and entrance angle in degrees of the luminance factor by day, 45/0, and the least of it that
/// is a base.
const DAY_DEG: f64 = 45.0;
const BLACK: f64 = 1e-4;
/// How far the logarithms of two values may differ that are the same: more than single precision makes of
/// them.
const SAME: f64 = 0.01;
/// Entrance angle in degrees at which the width of the material's curve is looked up.
const WIDTH_ENTRANCE_DEG: f64 = 5.0;
/// The widest half-power angle that the standards' observation angles show well, and the one that wider
/// curves are shown as: the angles are stretched.
const WIDEST_DEG: f64 = 1.0;
const SHOWN_AS_DEG: f64 = 0.5;

/// An angle to hundredths of a degree.
fn rounded(angle_deg: f64) -> f64 {
    (angle_deg * 100.0).round() / 100.0
}

/// What is exported.
pub(super) struct Original {
    /// The file or the standard's class, as the user named it.
    pub(super) name: String,
    /// The material: that of the document, or the one that was fitted to the table.
    pub(super) material: Material,
    photometer: Photometer,
    /// The values of the table, where it is one.
    pub(super) table: Option<Vec<Row>>,
    /// The colour that the table names.
    colour: Option<Colour>,
    /// The observations of the table as a fit sees them.
    observations: Vec<Observation>,
}

/// What a lobe is fitted to.
pub(super) struct Aims {
    pub(super) observations: Vec<Observation>,
    pub(super) colours: Colours,
    /// Luminance factor of the diffuse base; 0 where there is none.
    pub(super) base: f64,
}

/// Whether the value is a luminance factor by day.
fn is_by_day(row: &Observation) -> bool {
    row.views.iter().any(|view| view.wo.dot(view.wi) <= DAY_DEG.to_radians().cos() + 1e-6)
}

/// Whether the observations are at more observation angles than one.
fn has_several_angles(rows: &[Observation]) -> bool {
    let angle = |row: &Observation| {
        let view = &row.views[0];
        Geometry { wo: view.wo, wi: view.wi }.observation()
    };
    rows.iter().any(|row| (angle(row) - angle(&rows[0])).abs() > 1e-4)
}

/// The observations of the lobes, less what a base of this albedo returns there.
fn without_base(observations: Vec<Observation>, base: f64) -> Vec<Observation> {
    let less = |row: Observation| {
        let returned: f64 = row.views.iter().map(|view| view.factor * base / PI).sum();
        (row.value > returned).then_some(Observation { value: row.value - returned, ..row })
    };
    observations.into_iter().filter_map(less).collect()
}

impl Original {
    pub(super) fn load(args: &Args) -> anyhow::Result<Self> {
        let path = Path::new(&args.subject);
        let is_material = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtlx"));
        if is_material { Self::of_material(args, path) } else { Self::of_table(args) }
    }

    fn of_material(args: &Args, path: &Path) -> anyhow::Result<Self> {
        if args.only.is_some() || args.luminance_factor.is_some() {
            bail!(Usage(
                "--only and --luminance-factor are options of tables, and this is a material".to_owned()
            ));
        }
        let material = args.library.material(path, args.material.as_deref())?;
        let name = args.subject.clone();
        if !parts::is_retro(&material) {
            bail!("{name}: the material has no retro-reflective lobe; there is nothing to export");
        }
        if args.target.has_lobes_only() {
            parts::refuse_others(&name, &material, args.target == Target::Radiance)?;
        }
        let photometer = Photometer::new(&material, Model::Reciprocal, Channel::Luminance, None)?;
        Ok(Self { name, material, photometer, table: None, colour: None, observations: Vec::new() })
    }

    fn of_table(args: &Args) -> anyhow::Result<Self> {
        let mut subject = Subject::find(&args.subject, args.only.as_deref(), Cosine::AsStated)?;
        if subject.is_brdf() {
            bail!("{}: is a measured BRDF; fit it first, and export the material", subject.name);
        }
        subject.drop_minima_beside_values();
        let colour = subject.colour();
        if let Some(value) = args.luminance_factor {
            subject.add_luminance_factor(value)?;
        }
        let observations = subject.observations(false, None, &Apertures::both_deg(0.0).rule()?)?;
        let options = FitOptions {
            diffuse: subject.has_luminance_factor(),
            roughness: subject.roughness,
            channel_peak: colour.peak(),
            ..FitOptions::default()
        };
        let name = subject.name.clone();
        let found = fit(&observations, &options).with_context(|| name.clone())?;
        if found.fault.is_some() {
            bail!("{name}: what is fitted is no material between the rows; `catseye fit` says where");
        }
        let text = MaterialText { name: &name, doc: "", comment: "", colour, base_colour: colour };
        let document = Document::parse(&to_mtlx(&found.sheeting, &text), &name)?;
        let material = document.material(None)?;
        let photometer = Photometer::new(&material, Model::Reciprocal, Channel::Luminance, None)?;
        Ok(Self { name, material, photometer, table: Some(subject.rows), colour: Some(colour), observations })
    }

    pub(super) fn photometer(&self) -> &Photometer {
        &self.photometer
    }

    /// The BRDF of the material in 1/sr, in luminance.
    pub(super) fn brdf(&self, geometry: &Geometry) -> f64 {
        self.photometer.brdf(geometry).unwrap_or(f64::NAN)
    }

    /// `R_A` of the material over observation and entrance angle: at those of the standards, stretched where
    /// the lobe is wider than sheeting's, or at those that are asked for.
    pub(super) fn grid(&self, observations: &[f64], entrances: &[f64]) -> anyhow::Result<Table> {
        let stretch = self.stretch()?;
        let observations = match observations {
            [] => OBSERVATIONS_DEG.map(|angle| rounded(angle * stretch)).to_vec(),
            given => given.to_vec(),
        };
        let entrances = if entrances.is_empty() { &ENTRANCES_DEG } else { entrances };
        let geometries = grid(&observations, entrances)?;
        let rows = geometries.rows().iter().map(|row| {
            let value = self.photometer.measure(Quantity::RetroReflectionCoefficient, &row.geometry())?;
            Ok(Row { value: Some(value), ..row.clone() })
        });
        let rows = rows.collect::<anyhow::Result<Vec<Row>>>()?;
        Ok(Table::from_rows(geometries.name(), geometries.header(), rows))
    }

    /// What lobes are fitted to: the table, or the rows of the material's lobe, less what the base returns,
    /// so that a lobe that can't meet them does not bend the base.
    pub(super) fn aims(&self, lobe_rows: &[Row]) -> anyhow::Result<Aims> {
        let geometry =
            |observation, entrance| Geometry::from(Goniometer::from_degrees(observation, entrance, 0.0, 0.0));
        let day = self.photometer.rgb(&geometry(DAY_DEG, DAY_DEG))?;
        let y = PI * luminance(day);
        let base = if y > BLACK { y } else { 0.0 };
        let peak = self.photometer.rgb(&geometry(0.01, WIDTH_ENTRANCE_DEG))?;
        let lobe = [0, 1, 2].map(|c| (peak[c] - day[c]).max(0.0));
        let colour = |rgb| self.colour.or_else(|| Colour::from_rec709(rgb)).unwrap_or(Colour::WHITE);
        let colours = Colours { lobe: colour(lobe), base: colour(day) };
        self.refuse_rotation(lobe_rows)?;
        let seen: Vec<Observation> =
            self.observations.iter().filter(|row| !is_by_day(row)).cloned().collect();
        // A table at one observation angle says nothing of the width; what was fitted to it has one.
        let observations = if has_several_angles(&seen) {
            seen
        } else {
            let rows = lobe_rows.iter().map(|row| Observation::from_row(row, Aim::Equal, None));
            rows.collect::<Result<_, _>>()?
        };
        Ok(Aims { observations: without_base(observations, base), colours, base })
    }

    /// The albedo of a Lambertian base that looks the same at 45/0 below the coat.
    pub(super) fn base_by_day(&self, coat: Option<&Coat>) -> anyhow::Result<[f64; 3]> {
        let day = Geometry::from(Goniometer::from_degrees(DAY_DEG, DAY_DEG, 0.0, 0.0));
        let [through, gloss] =
            coat.map_or([1.0, 0.0], |coat| [coat.transmitted(day.wo), coat.gloss(day.wo, day.wi)]);
        Ok(self.photometer.rgb(&day)?.map(|f| PI * ((f - gloss) / through).max(0.0)))
    }

    /// Refuses a material whose lobe is wider in one direction of the sample than in another.
    fn refuse_rotation(&self, rows: &[Row]) -> anyhow::Result<()> {
        if self.depends_on_rotation(rows) {
            bail!(
                "{}: what it returns depends on the rotation of the sample, and this target has lobes of one \
                 width; export it to csv or openmaterial, at rotation 0",
                self.name
            );
        }
        Ok(())
    }

    /// Whether some of the rows would be another one with the sample turned.
    pub(super) fn depends_on_rotation(&self, rows: &[Row]) -> bool {
        let turned = |row: &Row, rotation_deg| self.brdf(&Row { rotation_deg, ..row.clone() }.geometry());
        rows.iter().any(|row| (turned(row, 90.0) / turned(row, 0.0)).ln().abs() > SAME)
    }

    /// By how much the observation angles of sheeting are too small: 1 for sheeting.
    fn stretch(&self) -> anyhow::Result<f64> {
        let r_a = |observation_deg: f64| {
            let angles = Goniometer::from_degrees(observation_deg, WIDTH_ENTRANCE_DEG, 0.0, 0.0);
            self.photometer.measure(Quantity::RetroReflectionCoefficient, &Geometry::from(angles))
        };
        // A twentieth of a degree apart where it matters; wider than 20 degrees is as wide as it gets.
        let half = 0.5 * r_a(0.01)?;
        let mut angle = WIDEST_DEG;
        while angle < 20.0 && r_a(angle)? > half {
            angle *= 1.05;
        }
        Ok(if angle > WIDEST_DEG { (angle / SHOWN_AS_DEG * 10.0).round() / 10.0 } else { 1.0 })
    }
}
