//! The coefficient of retro-reflection of a material file.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use serde_json::{Value, json};

use super::Metadata;
use crate::half_power::roughness_from_half_power_angle;
use crate::table::csv_text;
use crate::{Error, Limit, Table, Unit};

/// The greatest coefficient that the format can hold, cd/lx/m2.
pub const MAX_COEFFICIENT: f64 = 5000.0;
/// Bytes of the largest file that is read.
const LARGEST: u64 = 16 << 20;

/// What a file does not say of its coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption {
    /// Observation angle in degrees. Default 0.2, where data sheets begin.
    pub observation_deg: f64,
    /// Entrance angle in degrees. Default -4, nearly head-on, as data sheets have it.
    pub entrance_deg: f64,
    /// Observation angle in degrees at which the coefficient is half of what it is at 0. Default 0.4: the
    /// lobes that fit the minima of ASTM D4956 Types I to III have 0.37 to 0.42.
    pub half_power_deg: f64,
}

impl Default for Assumption {
    fn default() -> Self {
        Self { observation_deg: 0.2, entrance_deg: -4.0, half_power_deg: 0.4 }
    }
}

impl Assumption {
    /// The assumption as a sentence for the reader of a fit.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { observation_deg, entrance_deg, half_power_deg } = self;
        format!(
            "OpenMATERIAL 3D gives no angles: its coefficient is taken as R_A at {observation_deg} deg observation and \
             {entrance_deg} deg entrance, half of it left at {half_power_deg} deg observation"
        )
    }

    /// The roughness of a lobe with this half-power angle.
    ///
    /// # Errors
    /// As [`roughness_from_half_power_angle`].
    pub fn roughness(&self) -> Result<f64, Error> {
        roughness_from_half_power_angle(self.half_power_deg.to_radians())
    }
}

/// What a material file says of retro-reflection.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenMaterial {
    /// The material's display name.
    pub name: String,
    /// Coefficient of retro-reflection for visible light in cd/lx/m2, above 0 and at most 5000.
    pub coefficient: f64,
    /// Where the coefficient is from, in the file's words.
    pub sources: String,
}

impl OpenMaterial {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that can't be read, and everything that [`OpenMaterial::parse`] refuses.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let io = |source| Error::Io { path: path.to_owned(), source };
        let mut text = String::new();
        File::open(path).map_err(io)?.take(LARGEST).read_to_string(&mut text).map_err(io)?;
        Self::parse(&text, &path.display().to_string())
    }

    /// Reads the text of a `.xomp` file; `name` is what errors call it.
    ///
    /// # Errors
    /// Text that is no JSON, or without a coefficient, or with one outside the format's range; 0 as well,
    /// since nothing comes back then.
    pub fn parse(text: &str, name: &str) -> Result<Self, Error> {
        let fail = |problem: String| Error::Table { table: name.to_owned(), problem };
        let document: Value =
            serde_json::from_str(text).map_err(|error| fail(format!("is not a .xomp file: {error}")))?;
        let data = &document["materialProperties"]["retroreflectivityData"];
        let field = "materialProperties.retroreflectivityData.coefficientOfRetroreflection";
        let Some(coefficient) = data["coefficientOfRetroreflection"].as_f64() else {
            return Err(fail(format!("has no number at {field}: there is nothing to fit")));
        };
        if !(coefficient > 0.0 && coefficient <= MAX_COEFFICIENT) {
            let range = format!("above 0 and at most {MAX_COEFFICIENT} cd/lx/m2");
            return Err(fail(format!("{field} is {coefficient}; it must be {range}")));
        }
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let sources = text(&data["sources"]);
        Ok(Self { name: text(&document["metadata"]["name"]), coefficient, sources })
    }

    /// The coefficient as a table of one row, at the assumed angles.
    ///
    /// # Errors
    /// Angles that a table can't have.
    pub fn table(&self, assumption: &Assumption) -> Result<Table, Error> {
        let Assumption { observation_deg, entrance_deg, .. } = assumption;
        let header = ["class", "observation_deg", "entrance_deg", "value", "unit", "limit", "source"];
        let one_line = |text: &str| text.replace(['\r', '\n'], " ");
        let row = [
            one_line(&self.name),
            observation_deg.to_string(),
            entrance_deg.to_string(),
            self.coefficient.to_string(),
            Unit::CandelaPerLuxSquareMetre.to_string(),
            Limit::Typical.name().to_owned(),
            one_line(&self.sources),
        ];
        let text = csv_text(&header, std::iter::once(row.to_vec()));
        Table::parse_values(text.as_bytes(), "OpenMATERIAL 3D")
    }
}

/// A `.xomp` file with a coefficient of retro-reflection in cd/lx/m2.
///
/// `sources` says where it is from, angles included, since the format has no other place for them. `brdf` is
/// the relative path of the material's `_brdf.xompt`, if it has one.
///
/// # Errors
/// A coefficient outside the format's 0 to 5000, a path that doesn't end in `_brdf.xompt`.
pub fn write_material(
    metadata: &Metadata,
    coefficient: f64,
    sources: &str,
    brdf: Option<&str>,
) -> Result<String, Error> {
    let fail = |problem: String| Error::Table { table: format!("{}.xomp", metadata.name), problem };
    if !(0.0..=MAX_COEFFICIENT).contains(&coefficient) {
        return Err(fail(format!(
            "the coefficient {coefficient} cd/lx/m2 is outside the format's 0 to {MAX_COEFFICIENT}; choose a larger \
             observation angle"
        )));
    }
    let mut properties = json!({
        "retroreflectivityData": { "coefficientOfRetroreflection": coefficient, "sources": sources },
    });
    if let Some(uri) = brdf {
        if !uri.ends_with("_brdf.xompt") {
            return Err(fail(format!("the name of the table is {uri}; it must end in _brdf.xompt")));
        }
        properties["brdfUris"] = json!([uri]);
    }
    let mut document = metadata.document("material_schema", "material", None);
    document.insert("materialProperties".to_owned(), properties);
    Ok(format!("{:#}\n", Value::Object(document)))
}
