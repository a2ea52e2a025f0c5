//! `catseye export`: a material in the forms that other programs read.

mod openmaterial;
mod original;
mod parts;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use catseye::Model;
use catseye_photometry::export::{
    Deviation, Dielectric, LobeRows, OpenPbr, Radiance, SingleLobe, gltf, open_pbr, three,
};
use catseye_photometry::fit::{FitOptions, fit};
use catseye_photometry::{Geometry, MaterialText, luminance, to_mtlx};
use clap::ValueEnum;
use serde_json::{Value, json};

use self::openmaterial::OpenMaterialArgs;
use self::original::{Aims, Original};
use self::parts::{LeftOut, Parts};
use crate::failure::Usage;
use crate::options::LibraryArgs;
use crate::output::{Output, must_end_in};
use crate::{help, report};

/// The least roughness that three.js renders with; a smaller one is raised to it.
const THREE_LEAST_ROUGHNESS: f64 = 0.045;

/// Write a material, or what is fitted to a table, in the form that another program reads, and how far it is
/// off
///
/// Each target is told how far its coefficients of retro-reflection are from the original's: the worst error
/// and the root mean square, over the table's values where there are some, and over a grid of observation and
/// entrance angles. The file says it in a comment where it can have one. The MaterialX data library, which
/// shading languages need, comes from `catseye materialx export`.
#[derive(Debug, clap::Args)]
#[command(after_help = help::EXPORT)]
pub(crate) struct Args {
    /// What reads the file
    #[arg(value_enum)]
    target: Target,
    /// MaterialX document with the material, CSV file of values, or STANDARD:CLASS:COLOUR
    #[arg(value_name = "MATERIAL.mtlx|TABLE|STANDARD")]
    subject: String,
    /// File to write, which appears whole or not at all; `-` is standard output, where there is one file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Name of the surface material, where the document has several
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// Of a table, only the rows whose standard, class and colour contain this text
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Luminance factor Y by day (45/0) of a table's material, for the diffuse base
    #[arg(long, value_name = "Y")]
    luminance_factor: Option<f64>,
    /// Observation angles in degrees that csv has, and that lobes are fitted to and compared at [default:
    /// those of the standards for sheeting, stretched for lobes that are wider]
    #[arg(long, value_name = "DEG,...", value_delimiter = ',')]
    observations: Vec<f64>,
    /// The same for entrance angles, in degrees [default: those of the standards for sheeting]
    #[arg(long, value_name = "DEG,...", value_delimiter = ',', allow_hyphen_values = true)]
    entrances: Vec<f64>,
    #[command(flatten)]
    openmaterial: OpenMaterialArgs,
    /// Print what was written as JSON
    #[arg(long)]
    json: bool,
}

/// What reads the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Target {
    /// R_A over observation and entrance angle, as a table
    Csv,
    /// Radiance: a material (.rad) and its function file (.cal), the lobes themselves
    Radiance,
    /// glTF 2.0 with the draft extension for retro-reflection
    Gltf,
    /// three.js r187 or newer: a module with a physical material
    Three,
    /// OpenPBR 1.2, as a MaterialX document
    Openpbr,
    /// MaterialX 1.39.5 without our library: lobes with retroreflective = true, and their entrance laws
    MaterialxBackVector,
    /// ASAM OpenMATERIAL 3D: the one coefficient that it has room for (.xomp), and a table of the BRDF
    Openmaterial,
}

impl Target {
    /// How the name of its file ends.
    fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Radiance => "rad",
            Self::Gltf => "gltf",
            Self::Three => "js",
            Self::Openpbr | Self::MaterialxBackVector => "mtlx",
            Self::Openmaterial => "xomp",
        }
    }

    /// What reads it.
    fn reader(self) -> &'static str {
        match self {
            Self::Csv => "tables",
            Self::Radiance => "Radiance",
            Self::Gltf => "glTF 2.0 with KHR_materials_retroreflection (draft)",
            Self::Three => "three.js r187",
            Self::Openpbr => "OpenPBR 1.2",
            Self::MaterialxBackVector => "MaterialX 1.39.5",
            Self::Openmaterial => "ASAM OpenMATERIAL 3D",
        }
    }

    /// Whether the target has nothing but lobes and a base, the same everywhere.
    fn has_lobes_only(self) -> bool {
        !matches!(self, Self::Csv | Self::Openmaterial)
    }
}

impl Args {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        self.refuse_foreign_options()?;
        match self.target {
            Target::Csv => self.csv(),
            Target::Radiance => self.radiance(),
            Target::Gltf | Target::Three | Target::Openpbr => self.single_lobe(),
            Target::MaterialxBackVector => self.back_vector(),
            Target::Openmaterial => openmaterial::run(self),
        }
    }

    /// Refuses the options of other targets.
    fn refuse_foreign_options(&self) -> anyhow::Result<()> {
        let is_openmaterial = self.target == Target::Openmaterial;
        if is_openmaterial && !(self.observations.is_empty() && self.entrances.is_empty()) {
            bail!(Usage(
                "--observations and --entrances are no options of the target openmaterial".to_owned()
            ));
        }
        if !is_openmaterial && self.openmaterial.are_given() {
            let options = "--tint, --observation-deg and --entrance-deg";
            bail!(Usage(format!("{options} are options of the target openmaterial only")));
        }
        Ok(())
    }

    fn csv(&self) -> anyhow::Result<()> {
        must_end_in(&self.output, self.target.ending())?;
        let output = Output::new(&self.output)?;
        let original = Original::load(self)?;
        let table = original.grid(&self.observations, &self.entrances)?;
        if original.depends_on_rotation(&LobeRows::of(table.rows()).lobe) {
            report::warn(format!(
                "{}: R_A depends on the rotation of the sample; these are at 0",
                original.name
            ));
        }
        let values = table.rows().iter().map(|row| format!("{:?}", row.value.unwrap_or(f64::NAN)));
        output.write(table.to_csv(&[("value", values.collect())]).as_bytes())?;
        // The grid is the material itself.
        let deviations = Deviations::new(&original, &LobeRows::default(), |geometry| original.brdf(geometry));
        self.say(&[&output], &deviations, "", &Value::Null)
    }

    fn radiance(&self) -> anyhow::Result<()> {
        let functions = beside(&self.output, self.target.ending(), ".cal")?;
        let output = Output::new(&self.output)?;
        let functions_output = Output::new(&functions)?;
        let original = Original::load(self)?;
        let Parts { lobes, base, coat, left_out } = Parts::of(&original.name, &original.material)?;
        let base =
            if left_out.contains(&LeftOut::RoughBase) { original.base_by_day(coat.as_ref())? } else { base };
        let name = &original.material.name;
        let mut radiance = Radiance { name, remarks: &[], lobes: &lobes, base, coat };
        let brdf = |geometry: &Geometry| luminance(radiance.eval(geometry.wo, geometry.wi));
        let deviations = Deviations::new(&original, &self.grid(&original)?, brdf);
        let left_out: Vec<&str> = left_out.into_iter().map(LeftOut::sentence).collect();
        let mut remarks = self.remarks(&original, &deviations);
        remarks.extend(left_out.iter().map(|&sentence| sentence.to_owned()));
        radiance.remarks = &remarks;
        let file = functions.file_name().and_then(OsStr::to_str).unwrap_or_default();
        functions_output.write(radiance.functions().as_bytes())?;
        output.write(radiance.material(file).as_bytes())?;
        let numbers = json!({ "left_out": left_out });
        self.say(&[&output, &functions_output], &deviations, &left_out.join("\n"), &numbers)
    }

    /// `R_A` of the material over the angles that are asked for.
    fn grid(&self, original: &Original) -> anyhow::Result<LobeRows> {
        Ok(LobeRows::of(original.grid(&self.observations, &self.entrances)?.rows()))
    }

    /// The file to write, the original, and its `R_A` where lobes are fitted to it.
    fn open(&self) -> anyhow::Result<(Output, Original, LobeRows)> {
        must_end_in(&self.output, self.target.ending())?;
        let output = Output::new(&self.output)?;
        let original = Original::load(self)?;
        let grid = self.grid(&original)?;
        Ok((output, original, grid))
    }

    /// A target with one back-vector lobe of constant inputs.
    fn single_lobe(&self) -> anyhow::Result<()> {
        let (output, original, grid) = self.open()?;
        let Aims { observations, colours, base } = original.aims(&grid.lobe)?;
        let least_alpha = if self.target == Target::Three { THREE_LEAST_ROUGHNESS.powi(2) } else { 0.0 };
        let lobe = SingleLobe::fit(&observations, &colours, base, least_alpha)
            .with_context(|| original.name.clone())?;
        let name = &original.material.name;
        let (text, deviations, numbers) = if self.target == Target::Openpbr {
            let inputs = OpenPbr::new(&lobe);
            let deviations = Deviations::new(&original, &grid, |g| luminance(inputs.eval(g.wo, g.wi)));
            let numbers = json!({
                "base_color": inputs.base_color,
                "base_metalness": inputs.base_metalness,
                "specular_weight": inputs.specular_weight,
                "specular_roughness": inputs.specular_roughness,
                "specular_ior": 1.0,
                "specular_retroreflectivity": 1.0,
            });
            (open_pbr(name, &inputs, &self.remarks(&original, &deviations)), deviations, numbers)
        } else {
            let inputs = Dielectric::new(&lobe, self.target == Target::Three);
            let deviations = Deviations::new(&original, &grid, |g| luminance(inputs.eval(g.wo, g.wi)));
            let numbers = json!({
                "color": inputs.color,
                "roughness": inputs.roughness,
                "specular": inputs.specular,
                "specular_color": inputs.specular_color,
                "retroreflection": 1.0,
            });
            let remarks = self.remarks(&original, &deviations);
            let text = match self.target {
                Target::Three => three(name, &inputs, &remarks),
                _ => gltf(name, &inputs, &json!({ "remarks": remarks, "deviations": deviations.json() })),
            };
            (text, deviations, numbers)
        };
        output.write(text.as_bytes())?;
        self.say(&[&output], &deviations, "", &numbers)
    }

    /// The sheeting of back-vector lobes with entrance laws, as a graph of MaterialX's own nodes.
    fn back_vector(&self) -> anyhow::Result<()> {
        let (output, original, grid) = self.open()?;
        let Aims { observations, colours, base } = original.aims(&grid.lobe)?;
        let options = FitOptions {
            model: Model::BackVector,
            isotropic: true,
            channel_peak: colours.peak(),
            ..FitOptions::default()
        };
        let mut found = fit(&observations, &options).with_context(|| original.name.clone())?;
        if found.fault.is_some() {
            bail!(
                "{}: no back-vector lobes with entrance laws are physical between these values",
                original.name
            );
        }
        found.sheeting.diffuse = base;
        let prepared = found.sheeting.prepare()?;
        let deviations = Deviations::new(&original, &grid, |g| prepared.eval(g.wo, g.wi));
        let comment = self.remarks(&original, &deviations).join("\n    ");
        let (colour, base_colour) = (colours.lobe, colours.base);
        let text =
            MaterialText { name: &original.material.name, doc: "", comment: &comment, colour, base_colour };
        output.write(to_mtlx(&found.sheeting, &text).as_bytes())?;
        self.say(&[&output], &deviations, "", &Value::Null)
    }

    /// What a file says of itself, a line each.
    fn remarks(&self, original: &Original, deviations: &Deviations) -> Vec<String> {
        let title = format!("{} for {}, written by catseye export", original.name, self.target.reader());
        std::iter::once(title).chain(deviations.lines()).collect()
    }

    /// Says what was written.
    ///
    /// `numbers` are what the target is told, `text` the same in words, where there is something to say.
    fn say(
        &self,
        files: &[&Output],
        deviations: &Deviations,
        text: &str,
        numbers: &Value,
    ) -> anyhow::Result<()> {
        let names: Vec<String> = files.iter().map(|file| file.name()).collect();
        let mut lines = vec![format!("wrote {}", names.join(" and "))];
        lines.extend((!text.is_empty()).then(|| text.to_owned()));
        lines.extend(deviations.lines());
        let facts = json!({
            "target": name(self.target),
            "files": names,
            "deviations": deviations.json(),
            "parameters": numbers,
        });
        files[0].messages().note(self.json, &facts, &lines.join("\n"))
    }
}

/// How far an exported material is from its original.
struct Deviations(Vec<(&'static str, Deviation)>);

impl Deviations {
    fn new(original: &Original, grid: &LobeRows, brdf: impl Fn(&Geometry) -> f64) -> Self {
        let table = original.table.as_deref().unwrap_or_default();
        let all = [("table", table), ("lobe", &grid.lobe), ("tail", &grid.tail)];
        let against = |(what, rows)| Some((what, Deviation::of(rows, &brdf)?));
        Self(all.into_iter().filter_map(against).collect())
    }

    /// A sentence each.
    fn lines(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|(what, deviation)| match *what {
            "table" => format!("against the table: {deviation}"),
            "lobe" => format!("R_A in the lobe, from its peak to a tenth: {deviation}"),
            _ => format!("R_A in its tail, from a tenth to a hundredth: {deviation}"),
        })
    }

    fn json(&self) -> Value {
        let one = |(what, deviation): &(&str, Deviation)| {
            let Deviation { rows, worst, worst_at_deg: [observation_deg, entrance_deg], rms } = *deviation;
            json!({
                "against": what,
                "values": rows,
                "worst": worst,
                "observation_deg": observation_deg,
                "entrance_deg": entrance_deg,
                "rms": rms,
            })
        };
        self.0.iter().map(one).collect()
    }
}

/// The second file of a target that writes two: named as the first one, which must end in `ending`.
fn beside(output: &Path, ending: &str, other: &str) -> anyhow::Result<PathBuf> {
    match output.file_stem().and_then(OsStr::to_str) {
        Some(stem) if output.extension() == Some(OsStr::new(ending)) => {
            Ok(output.with_file_name(format!("{stem}{other}")))
        }
        _ => bail!(Usage(format!("{}: the name must end in .{ending}", output.display()))),
    }
}

/// The name of a target on the command line.
fn name(target: Target) -> String {
    target.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}
