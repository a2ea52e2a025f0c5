//! Which column means what: the names of headers, in their many spellings.

use crate::table::Need;
use crate::{Quantity, Unit};

/// Characters of a cell that a message repeats.
const LONGEST: usize = 40;

/// A column that has a meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    Observation,
    Entrance,
    Entrance2,
    Rotation,
    Quantity,
    Value,
    Unit,
    Limit,
    Uncertainty,
    Wavelength,
    SourceAperture,
    ReceiverAperture,
    Standard,
    Class,
    Colour,
    Source,
}

/// The columns: the name that is written, the unit that it ends in, and what else it is called. Compared in
/// lower case, without spaces, signs and the word angle.
const NAMES: [(Column, &str, &[&str]); 16] = [
    (
        Column::Observation,
        "observation_deg",
        &["observation", "obs", "alpha", "α", "observationalpha", "observationα", "beobachtungswinkel"],
    ),
    (
        Column::Entrance,
        "entrance_deg",
        &[
            "entrance",
            "ent",
            "beta",
            "β",
            "beta1",
            "β1",
            "entrance1",
            "entrancebeta",
            "entranceβ",
            "entrancebeta1",
            "entranceβ1",
            "entry",
            "incidence",
            "anleuchtungswinkel",
        ],
    ),
    (Column::Entrance2, "beta_2_deg", &["beta2", "β2", "entrance2", "ent2", "entrancebeta2", "entranceβ2"]),
    (
        Column::Rotation,
        "rotation_deg",
        &["rotation", "rot", "epsilon", "ε", "rotationepsilon", "rotationε", "drehwinkel"],
    ),
    (Column::Quantity, "quantity", &["quantity"]),
    (
        Column::Value,
        "value",
        &[
            "value",
            "values",
            "wert",
            "messwert",
            "measured",
            "reading",
            "coefficient",
            "retroreflection",
            "coefficientretroreflection",
        ],
    ),
    (Column::Unit, "unit", &["unit", "units", "einheit"]),
    (Column::Limit, "limit", &["limit"]),
    (
        Column::Uncertainty,
        "uncertainty",
        &[
            "uncertainty",
            "standarduncertainty",
            "sigma",
            "σ",
            "sd",
            "stddev",
            "standarddeviation",
            "unsicherheit",
            "messunsicherheit",
            "standardunsicherheit",
        ],
    ),
    (Column::Wavelength, "wavelength_nm", &["wavelength", "lambda", "λ", "wellenlänge"]),
    (Column::SourceAperture, "source_aperture_deg", &["sourceaperture", "aperturesource"]),
    (Column::ReceiverAperture, "receiver_aperture_deg", &["receiveraperture", "aperturereceiver"]),
    (Column::Standard, "standard", &["standard"]),
    (Column::Class, "class", &["class"]),
    (Column::Colour, "colour", &["colour", "color"]),
    (Column::Source, "source", &["source"]),
];

/// Names of what can't be left out and isn't read, where a table is read for this or more, and the way out.
const REFUSED: [(Need, &[&str], &str); 2] = [
    (
        Need::Values,
        &["u", "u95", "expandeduncertainty", "uncertaintyk=2", "uk=2", "expandeduncertaintyk=2"],
        "give the standard uncertainty (half of an expanded one with k = 2) in a column `uncertainty`",
    ),
    (
        Need::Geometry,
        &["presentation", "presentationgamma", "orientationomegas", "omegas", "ωs"],
        "is an angle of another goniometer system; give observation_deg, entrance_deg (beta_1), beta_2_deg \
         and rotation_deg",
    ),
];

/// Words of a name that say nothing.
const EMPTY_WORDS: [&str; 7] = ["angle", "angles", "in", "of", "the", "component", "winkel"];
const DEGREES: [&str; 6] = ["deg", "degree", "degrees", "°", "º", "grad"];
const MINUTES: [&str; 10] =
    ["min", "arcmin", "minute", "minutes", "arcminute", "arcminutes", "'", "′", "’", "minuten"];
const BRACKETS: [char; 3] = ['(', '[', '{'];
const SIGNS: [char; 6] = ['°', 'º', '\'', '′', '’', '%'];
const PERCENT: [&str; 3] = ["%", "percent", "prozent"];

/// A column of a header, and what the header says beside its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Heading {
    pub(crate) column: Column,
    /// Whether angles are in minutes of arc.
    pub(crate) minutes: bool,
    /// Whether uncertainties are in percent of the value.
    pub(crate) percent: bool,
    /// The unit that a column of values or uncertainties names.
    pub(crate) unit: Option<Unit>,
    /// The quantity that a column of values names.
    pub(crate) quantity: Option<Quantity>,
}

impl Column {
    /// The name that is written.
    pub(crate) fn name(self) -> &'static str {
        NAMES.iter().find(|(column, ..)| *column == self).map_or("", |(_, name, _)| name)
    }

    /// Whether its cells are angles.
    pub(crate) fn is_angle(self) -> bool {
        self.name().ends_with("_deg")
    }

    /// Whether its cells are numbers.
    pub(crate) fn is_number(self) -> bool {
        self.is_angle() || matches!(self, Self::Value | Self::Uncertainty | Self::Wavelength)
    }
}

/// Whether a header's name has a meaning.
pub(crate) fn is_known(name: &str) -> bool {
    heading(name).is_ok_and(|heading| heading.is_some())
}

/// What a header's name means, if anything; a text says what is wrong with it.
fn heading(name: &str) -> Result<Option<Heading>, String> {
    let text = name.trim().to_lowercase().replace('₁', "1").replace('₂', "2");
    let plain = |column, quantity| Heading { column, minutes: false, percent: false, unit: None, quantity };
    let has_sign = text.contains(BRACKETS) || text.ends_with(SIGNS);
    let whole = if has_sign { quantity(&text).map(|q| (Column::Value, Some(q))) } else { meaning(&text) };
    if let Some((column, quantity)) = whole {
        return Ok(Some(plain(column, quantity)));
    }
    let Some((rest, unit, is_bracketed)) = split_unit(&text) else { return Ok(None) };
    let Some((column, quantity)) = meaning(rest) else { return Ok(None) };
    let (minutes, percent) = (MINUTES.contains(&unit), PERCENT.contains(&unit));
    let found = plain(column, quantity);
    let as_unit = unit.parse::<Unit>().ok();
    Ok(Some(match column {
        _ if column.is_angle() && (minutes || DEGREES.contains(&unit)) => Heading { minutes, ..found },
        Column::Uncertainty if percent => Heading { percent, ..found },
        Column::Value | Column::Uncertainty if as_unit.is_some() => Heading { unit: as_unit, ..found },
        Column::Wavelength if unit == "nm" => found,
        // `Observation angle (α)`, `value (R_A)`.
        _ if is_bracketed && meaning(unit).is_some_and(|(other, _)| other == column) => {
            Heading { quantity: quantity.or(meaning(unit).and_then(|(_, quantity)| quantity)), ..found }
        }
        _ if is_bracketed && column.is_number() => {
            let known = match column {
                Column::Wavelength => "nm",
                Column::Value | Column::Uncertainty => "cd/lx/m2, mcd/lx/m2, 1/sr, ... and %",
                _ => "degrees (deg) and minutes of arc (min)",
            };
            return Err(format!(
                "column {}: {} is no unit that it can have; {known} are read",
                shown(name),
                shown(unit)
            ));
        }
        // `observation_note` is none.
        _ => return Ok(None),
    }))
}

/// What a name without a unit means, and the quantity that it names.
fn meaning(text: &str) -> Option<(Column, Option<Quantity>)> {
    let joined = joined(text);
    if let Some((column, ..)) = NAMES.iter().find(|(_, _, names)| names.contains(&joined.as_str())) {
        return Some((*column, None));
    }
    quantity(&joined).map(|quantity| (Column::Value, Some(quantity)))
}

/// The quantity that a name is the symbol of. R alone is read as R' as often as as R_I, and f and Y are names
/// of many things.
fn quantity(text: &str) -> Option<Quantity> {
    text.parse().ok().filter(|_| text.trim().chars().count() > 1)
}

/// Letters, digits and what a name needs, without the words that say nothing.
fn joined(text: &str) -> String {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '=')).filter(|word| !word.is_empty());
    words.filter(|word| !EMPTY_WORDS.contains(word)).collect()
}

/// A name and the unit behind it, and whether that has brackets: `alpha (deg)`, `alpha [']`, `alpha_min`,
/// `alpha/°`, `R_A in cd/(lx m2)`.
fn split_unit(text: &str) -> Option<(&str, &str, bool)> {
    let opening = text.find(BRACKETS).filter(|start| !text[..*start].ends_with('/'));
    if let Some(start) = opening {
        let end = text.rfind([')', ']', '}']).filter(|end| *end > start)?;
        return Some((&text[..start], text[start + 1..end].trim(), true));
    }
    let sign = text.chars().next_back().filter(|c| SIGNS.contains(c));
    let (name, unit) = match sign {
        Some(sign) => text.split_at(text.len() - sign.len_utf8()),
        None => text.rsplit_once([' ', '_']).or_else(|| text.split_once('/'))?,
    };
    Some((name, unit, false))
}

/// Where each column stands.
#[derive(Debug)]
pub(crate) struct Columns(Vec<(usize, Heading)>);

impl Columns {
    /// Finds the columns; a text says what is wrong with the header.
    pub(crate) fn new(header: &[String], need: Need) -> Result<Self, String> {
        let same = |a: &str, b: &str| a.eq_ignore_ascii_case(b);
        let doubled =
            |i: usize| !header[i].is_empty() && header[..i].iter().any(|name| same(name, &header[i]));
        if let Some(i) = (0..header.len()).find(|&i| doubled(i)) {
            return Err(format!("column {} appears twice", shown(&header[i])));
        }
        for name in header {
            let plain = joined(&name.to_lowercase());
            let known = REFUSED.iter().find(|(of, names, _)| *of <= need && names.contains(&plain.as_str()));
            if let Some((.., cure)) = known {
                return Err(format!("column {}: {cure}", shown(name)));
            }
        }
        let mut found: Vec<(usize, Heading)> = Vec::new();
        for (column, canonical, _) in NAMES {
            let mut of: Vec<(usize, Heading)> = Vec::new();
            for (i, name) in header.iter().enumerate() {
                of.extend(
                    heading(name)?.filter(|heading| heading.column == column).map(|heading| (i, heading)),
                );
            }
            // The name that is written is no one else's: what is called so beside it is another column.
            if let Some(exact) = of.iter().find(|(i, _)| same(&header[*i], canonical)).copied() {
                of.retain(|(i, heading)| *i == exact.0 || heading.minutes);
            }
            if let [(first, _), (second, _), ..] = of[..] {
                let [first, second] = [first, second].map(|i| shown(&header[i]));
                return Err(format!("columns {first} and {second} both mean {canonical}; keep one of them"));
            }
            found.extend(of);
        }
        let columns = Self(found);
        let needed: &[Column] = match need {
            Need::Geometry => &[Column::Observation, Column::Entrance],
            Need::Values => &[Column::Observation, Column::Entrance, Column::Value],
        };
        let missing: Vec<Column> =
            needed.iter().copied().filter(|&name| columns.of(name).is_none()).collect();
        if missing.is_empty() { Ok(columns) } else { Err(missing_text(&missing, header)) }
    }

    /// Where a column stands, and what the header says of it.
    pub(crate) fn of(&self, column: Column) -> Option<(usize, Heading)> {
        self.0.iter().copied().find(|(_, heading)| heading.column == column)
    }

    /// What the name of the column of values says, and a column of its own should: unit and quantity.
    pub(crate) fn added(&self) -> impl Iterator<Item = Column> {
        let of = self.of(Column::Value).map(|(_, heading)| heading);
        let unit = of.and_then(|heading| heading.unit).map(|_| Column::Unit);
        let quantity = of.and_then(|heading| heading.quantity).map(|_| Column::Quantity);
        unit.into_iter().chain(quantity)
    }

    /// The header as it is written: each column by its one name, and those that are added behind.
    pub(crate) fn canonical(&self, header: &[String]) -> Vec<String> {
        let mut names = header.to_vec();
        for (i, heading) in self.iter() {
            heading.column.name().clone_into(&mut names[i]);
        }
        let added = self.added().filter(|column| self.of(*column).is_none());
        names.extend(added.map(|column| column.name().to_owned()));
        names
    }

    /// The columns that there are, and where they stand.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, Heading)> {
        self.0.iter().copied()
    }
}

fn missing_text(missing: &[Column], header: &[String]) -> String {
    let names: Vec<&str> = missing.iter().map(|column| column.name()).collect();
    let noun = if names.len() == 1 { "column" } else { "columns" };
    let missing = format!("missing {noun} {}", names.join(", "));
    if header.iter().all(|name| name.replace(',', ".").parse::<f64>().is_ok() || name.is_empty()) {
        return format!("{missing}; the first line has to name the columns");
    }
    if let [only] = header {
        return format!("{missing}; all there is is {}: separate columns with `,`, `;` or tabs", shown(only));
    }
    let there: Vec<String> = header.iter().take(8).map(|name| shown(name)).collect();
    let more = if header.len() > there.len() { ", ..." } else { "" };
    format!(
        "{missing}; there are {}{more}: `catseye fit --help` lists the names that are read",
        there.join(", ")
    )
}

/// A cell's text in quotes, cut short where it is long.
pub(crate) fn shown(text: &str) -> String {
    let mut start: String = text.chars().take(LONGEST).collect();
    if start.len() < text.len() {
        start.push_str("...");
    }
    format!("{start:?}")
}
