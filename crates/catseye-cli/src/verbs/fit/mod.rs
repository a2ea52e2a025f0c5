//! `catseye fit`: from coefficients of retro-reflection to a material.

mod figures;
mod outcome;
mod page;
mod provenance;
pub(crate) mod subject;

use std::path::{Path, PathBuf};

use anyhow::bail;
use catseye::Model;
use catseye_photometry::brdf::{BrdfFitError, Cosine, Part};
use catseye_photometry::fit::{EntranceKind, Fit, FitError, FitOptions, Observation, fit};
use catseye_photometry::half_power::roughness_from_half_power_angle;
use catseye_photometry::{Apertures, Colour, MaterialText, to_mtlx};
use clap::ValueEnum;

use self::outcome::Outcome;
use self::page::{Context, page};
use self::subject::Subject;
use crate::failure::Usage;
use crate::help;
use crate::instrument::check_area;
use crate::output::{Output, must_end_in};
use crate::progress::Progress;
use crate::report::Stream;

/// Percent by which a model of a measured BRDF may be off on average: what three lobes make of real tapes.
const BRDF_TOLERANCE: f64 = 40.0;

/// Fit a material to coefficients of retro-reflection, of a CSV table or of a standard's class
///
/// Finds a sum of retro-reflective lobes with entrance laws, and a diffuse base where a luminance factor
/// is given, whose albedo is at most 1. `catseye standards list` names the classes that come with the
/// program. Without a wish, the simplest model whose worst value is within the tolerance is chosen. Exit
/// code 1 if there is none; then no material is written. Values with a column uncertainty are fitted by
/// least squares with that weight; values unlike the others are named.
#[derive(Debug, clap::Args)]
#[command(after_help = help::fit())]
pub(crate) struct Args {
    /// CSV file, STANDARD:CLASS:COLOUR, ALTA .dat or MERL .binary of a measured BRDF, or ASAM OpenMATERIAL
    /// .xomp
    #[arg(value_name = "TABLE|STANDARD")]
    subject: String,
    /// Write the material to this .mtlx file; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write a report to this .html file, whatever comes out; its date is that of `SOURCE_DATE_EPOCH`, where
    /// that is set, or now
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Fit only the rows whose standard, class and colour contain this text
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Lobes: 1, 2, 3 or auto, which gives a table two at most
    #[arg(long, value_name = "N", default_value = "auto")]
    lobes: String,
    /// How the strength depends on the entrance angle
    #[arg(long, value_enum, default_value_t)]
    entrance: Entrance,
    /// The worst error that is accepted, in percent; of a measured BRDF the root mean square, where 95 % of
    /// the samples may be twice and every one four times as far off, in logarithms [default: 5, of a BRDF 40]
    #[arg(long, value_name = "PERCENT")]
    tolerance: Option<f64>,
    /// The root mean square of the errors that is accepted instead, in percent: for measurements with noise
    #[arg(long, value_name = "PERCENT", conflicts_with = "tolerance")]
    tolerance_rms: Option<f64>,
    /// Meet minima, the rows whose column limit says so, as lower limits instead of as values
    #[arg(long)]
    at_least: bool,
    /// Half-power angle of a single lobe in degrees, where the table can't tell it
    #[arg(long, value_name = "DEG")]
    half_power_deg: Option<f64>,
    /// Luminance factor Y by day (45/0), for the diffuse base
    #[arg(long, value_name = "Y")]
    luminance_factor: Option<f64>,
    /// Put a clear coat of this index of refraction over the lobes; a measured BRDF with a mirror peak has
    /// one anyway
    #[arg(long, value_name = "IOR", num_args = 0..=1, default_missing_value = "1.5")]
    coat: Option<f64>,
    /// Colour of the tint, a name or linear Rec. 709 [default: what the rows name]
    #[arg(long, value_name = "NAME|R,G,B")]
    colour: Option<Colour>,
    /// Area of the whole reflector, which coefficients of luminous intensity are of
    #[arg(long, value_name = "M2")]
    area_m2: Option<f64>,
    /// Full angle of the instrument's source and receiver apertures in degrees, where a row has none
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    aperture_deg: f64,
    /// Whether the values of an ALTA file include the receiver's cosine [default: what its header says,
    /// where the values of exchanged directions don't speak against it]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    cosine: Option<bool>,
    /// Lobe model
    #[arg(long, value_enum, default_value_t)]
    model: FitModel,
    /// Name of the material, and title of the report [default: the file's; what the rows say]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// How the strength of the lobes may depend on the entrance angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Entrance {
    /// The simplest that does
    #[default]
    Auto,
    /// Not at all
    None,
    /// As a power of the cosine
    Power,
    /// Flat at first, with one bend, then as a power of the tangent
    Bend,
}

/// The models that sheeting is fitted with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum FitModel {
    /// The proposal's lobe: `retro_reflective_bsdf`
    #[default]
    Reciprocal,
    /// The microfacet lobe of MaterialX 1.39.5: `generalized_schlick_bsdf` with `retroreflective`
    BackVector,
}

/// What is fitted, how, and where the result goes.
struct Job {
    subject: Subject,
    observations: Vec<Observation>,
    apertures: Apertures,
    /// How good the fit is in the regions of a measured BRDF.
    parts: Vec<Part>,
    options: FitOptions,
    colour: Colour,
    material: Option<Output>,
    page: Option<Output>,
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let mut job = self.job()?;
        let (found, beside) = job.fit()?;
        let outcome = job.outcome(&found, beside.as_ref());
        if let Some(file) = &job.page {
            let is_written = found.acceptable && outcome.fault().is_none();
            let context = Context {
                title: self.name.as_ref().unwrap_or(&job.subject.title),
                apertures: job.subject.apertures().unwrap_or(job.apertures),
                colour: job.colour,
                area_m2: self.area_m2,
                material: job.material.as_ref().filter(|_| is_written).map(Output::name),
            };
            file.write(page(&outcome, &context)?.as_bytes())?;
        }
        job.messages().print(self.json, &outcome.json(), &outcome.text())?;
        if let Some(fault) = outcome.fault() {
            bail!("{}: not written: {fault}", job.subject.name);
        }
        if !found.acceptable {
            bail!("{}: no acceptable fit; --tolerance would accept a worse one", job.subject.name);
        }
        match &job.material {
            Some(file) => file.write(self.document(&outcome, job.colour).as_bytes()),
            None => Ok(()),
        }
    }

    fn job(&self) -> anyhow::Result<Job> {
        let [material, page] = self.outputs()?;
        let options = self.options()?;
        let mut subject = Subject::find(&self.subject, self.only.as_deref(), self.cosine())?;
        match self.at_least {
            true => subject.check_for_minima()?,
            false => subject.drop_minima_beside_values(),
        }
        let colour = self.colour.unwrap_or_else(|| subject.colour());
        if let Some(value) = self.luminance_factor {
            subject.add_luminance_factor(value)?;
        }
        let apertures = Apertures::both_deg(self.aperture_deg);
        let rule = apertures.rule()?;
        let observations = subject.observations(self.at_least, self.area_m2, &rule)?;
        let options = FitOptions {
            diffuse: self.luminance_factor.is_some() || subject.has_luminance_factor() || subject.is_brdf(),
            isotropic: subject.is_brdf(),
            channel_peak: colour.peak(),
            roughness: options.roughness.or(subject.roughness),
            tolerance: 0.01
                * self.tolerance.or(self.tolerance_rms).unwrap_or(if subject.is_brdf() {
                    BRDF_TOLERANCE
                } else {
                    5.0
                }),
            of_rms: self.tolerance_rms.is_some() || subject.is_brdf(),
            ..options
        };
        Ok(Job { subject, observations, apertures, parts: Vec::new(), options, colour, material, page })
    }

    /// The material's file and the report's.
    fn outputs(&self) -> anyhow::Result<[Option<Output>; 2]> {
        let [material, page] = [&self.output, &self.report].map(Option::as_deref);
        if let Some(path) = material {
            must_end_in(path, "mtlx")?;
        }
        if let Some(path) = page {
            must_end_in(path, "html")?;
        }
        if material.is_some() && material == page {
            bail!(Usage("--output and --report are the same file".to_owned()));
        }
        Ok([material.map(Output::new).transpose()?, page.map(Output::new).transpose()?])
    }

    fn cosine(&self) -> Cosine {
        match self.cosine {
            None => Cosine::AsStated,
            Some(true) => Cosine::Included,
            Some(false) => Cosine::Excluded,
        }
    }

    fn options(&self) -> anyhow::Result<FitOptions> {
        let lobes = match self.lobes.as_str() {
            "auto" => None,
            number => match number.parse() {
                Ok(lobes @ 1..=3) => Some(lobes),
                _ => bail!(Usage(format!("--lobes is {number:?}: it must be 1, 2, 3 or auto"))),
            },
        };
        let roughness = self.half_power_deg.map(|angle| roughness_from_half_power_angle(angle.to_radians()));
        let entrance = match self.entrance {
            Entrance::Auto => None,
            Entrance::None => Some(EntranceKind::Constant),
            Entrance::Power => Some(EntranceKind::Power),
            Entrance::Bend => Some(EntranceKind::Bend),
        };
        let model = match self.model {
            FitModel::Reciprocal => Model::Reciprocal,
            FitModel::BackVector => Model::BackVector,
        };
        check_area(self.area_m2)?;
        Ok(FitOptions {
            model,
            lobes,
            entrance,
            roughness: roughness.transpose()?,
            coat_ior: self.coat,
            ..FitOptions::default()
        })
    }

    fn document(&self, outcome: &Outcome<'_>, colour: Colour) -> String {
        let subject = outcome.subject;
        let file = self.output.as_deref().filter(|path| *path != Path::new("-"));
        let stem = file.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
        let name = self.name.clone().or(stem).unwrap_or_else(|| subject.name.clone());
        let title = &subject.title;
        let command = provenance::command_of_result();
        let doc = format!("Fitted to {title} by catseye {command}: {}.", outcome.verdict());
        let sources = subject.sources().join("; ");
        let source =
            if sources.is_empty() { String::new() } else { format!(" Source of the values: {sources}") };
        let comment = format!("Written by catseye fit.{source}");
        let text = MaterialText { name: &name, doc: &doc, comment: &comment, colour, base_colour: colour };
        to_mtlx(&outcome.fit.sheeting, &text)
    }
}

impl Job {
    /// The fit, and for comparison that of the other model.
    fn fit(&mut self) -> anyhow::Result<(Fit, Option<Fit>)> {
        let _progress = Progress::unknown("fitting");
        let other = FitOptions { model: Model::BackVector, roughness: None, ..self.options };
        let is_other = self.options.model == Model::BackVector;
        if let Some(brdf) = self.subject.brdf() {
            let selection = self.subject.selection();
            let of = |options| brdf.fit(&selection, self.apertures, options);
            let found = of(&self.options).map_err(|error| match error {
                BrdfFitError::Fit(error) => self.failure(error),
                error => error.into(),
            })?;
            let beside = if is_other { None } else { of(&other).ok().map(|other| other.fit) };
            (self.observations, self.parts) = (found.observations, found.parts);
            return Ok((found.fit, beside));
        }
        let mut found = fit(&self.observations, &self.options).map_err(|error| self.failure(error))?;
        found.warnings.extend(self.subject.outliers(&found));
        let beside = if is_other { None } else { fit(&self.observations, &other).ok() };
        Ok((found, beside))
    }

    /// What is wrong, with the name of the data where it is their fault.
    fn failure(&self, error: FitError) -> anyhow::Error {
        match error {
            FitError::Option { .. } => error.into(),
            _ => anyhow::Error::from(error).context(self.subject.name.clone()),
        }
    }

    fn outcome<'a>(&'a self, fit: &'a Fit, beside: Option<&'a Fit>) -> Outcome<'a> {
        let Self { subject, observations, parts, .. } = self;
        let FitOptions { tolerance, of_rms, .. } = self.options;
        Outcome { subject, observations, parts, fit, beside, tolerance, of_rms }
    }

    /// Where text goes: not between the lines of a file.
    fn messages(&self) -> Stream {
        let files = [&self.material, &self.page].into_iter().flatten();
        files.map(Output::messages).find(|stream| *stream == Stream::Err).unwrap_or(Stream::Out)
    }
}
