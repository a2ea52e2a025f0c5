//! Looks: which geometry has which material.

use std::collections::HashMap;

use crate::{
    error::{Error, Warning, quoted},
    text::element::Element,
};

/// A look of a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Look {
    /// Its name.
    pub name: String,
    /// In the document's order; a later one is preferred.
    pub assignments: Vec<Assignment>,
}

/// A material for geometry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The name of the material.
    pub material: String,
    /// Paths of geometry, as in `/car/body`; each stands for all that is below it, and `*` for any characters
    /// of one part of a path.
    pub geometry: Vec<String>,
}

impl Look {
    /// The material of the geometry with this path.
    #[must_use]
    pub fn material(&self, path: &str) -> Option<&str> {
        let assigned =
            |assignment: &&Assignment| assignment.geometry.iter().any(|pattern| matches_path(pattern, path));
        self.assignments.iter().rev().find(assigned).map(|assignment| assignment.material.as_str())
    }
}

/// Whether a path is one that the pattern names, or below it.
fn matches_path(pattern: &str, path: &str) -> bool {
    let parts =
        |text: &str| text.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect::<Vec<_>>();
    let (pattern, path) = (parts(pattern), parts(path));
    pattern.len() <= path.len()
        && pattern.iter().zip(&path).all(|(pattern, part)| matches_part(pattern, part))
}

/// Whether a part of a path fits a pattern with `*`: greedy, in time proportional to the product of the
/// lengths.
fn matches_part(pattern: &str, part: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else { return pattern == part };
    let Some(mut left) = part.strip_prefix(first) else { return false };
    let pieces: Vec<&str> = rest.split('*').collect();
    let (last, middle) = pieces.split_last().map_or(("", &[][..]), |(last, middle)| (*last, middle));
    for piece in middle {
        let Some(at) = left.find(piece) else { return false };
        left = &left[at + piece.len()..];
    }
    left.ends_with(last)
}

/// The looks of a document, inherited assignments first.
pub(crate) fn looks(root: &Element) -> Result<Vec<Look>, Error> {
    let names =
        |tag| root.children_of_kind(tag).filter_map(|element: &Element| Some((element.name()?, element)));
    let known = Known {
        looks: names("look").collect(),
        materials: names("surfacematerial").collect(),
        collections: names("collection").collect(),
    };
    let mut count = 0;
    root.children_of_kind("look").map(|look| read(&known, look, &mut count)).collect()
}

/// What looks refer to.
struct Known<'a> {
    looks: HashMap<&'a str, &'a Element>,
    materials: HashMap<&'a str, &'a Element>,
    collections: HashMap<&'a str, &'a Element>,
}

/// Assignments of all looks together, inherited ones counted where they arrive.
const MAX_ASSIGNMENTS: usize = 100_000;

fn read<'a>(known: &Known<'a>, look: &'a Element, count: &mut usize) -> Result<Look, Error> {
    /// Looks that inherit from one another; a cycle ends here too.
    const MAX_INHERITANCE: usize = 8;
    let parent =
        |look: &&'a Element| look.attribute("inherit").and_then(|name| known.looks.get(name).copied());
    let chain: Vec<&Element> = core::iter::successors(Some(look), parent).take(MAX_INHERITANCE).collect();
    let mut assignments = Vec::new();
    for look in chain.into_iter().rev() {
        for assign in look.children_of_kind("materialassign") {
            *count += 1;
            if *count > MAX_ASSIGNMENTS {
                let what = "material assignments";
                return Err(Error::Limit { at: look.place(), what, limit: MAX_ASSIGNMENTS });
            }
            assignments.push(assignment(known, look, assign)?);
        }
    }
    Ok(Look { name: look.require("name")?.to_owned(), assignments })
}

fn assignment(known: &Known<'_>, look: &Element, assign: &Element) -> Result<Assignment, Error> {
    let material = look.require_of(assign, "material")?;
    if !known.materials.contains_key(material) {
        let target = format!("material={}", quoted(material));
        return Err(Error::Dangling { at: look.place_of(assign), target });
    }
    let mut geometry = paths(assign.attribute("geom").unwrap_or_default());
    if let Some(collection) = assign.attribute("collection").and_then(|name| known.collections.get(name)) {
        geometry.extend(paths(collection.attribute("includegeom").unwrap_or_default()));
    }
    Ok(Assignment { material: material.to_owned(), geometry })
}

/// A list of paths, separated by commas.
fn paths(text: &str) -> Vec<String> {
    text.split(',').map(str::trim).filter(|path| !path.is_empty()).map(str::to_owned).collect()
}

/// A line for every unit that is named but not converted.
pub(crate) fn warnings(root: &Element) -> Vec<Warning> {
    let mut warnings = Vec::new();
    collect_warnings(root, &mut warnings);
    warnings
}

fn collect_warnings(element: &Element, warnings: &mut Vec<Warning>) {
    /// What is said at most.
    const MOST: usize = 100;
    for child in element.children() {
        if let Some(message) = warning(child)
            && warnings.len() < MOST
        {
            warnings.push(Warning { at: element.place_of(child), message });
        }
        collect_warnings(child, warnings);
    }
}

fn warning(element: &Element) -> Option<String> {
    // Degrees and nanometres are what the nodes take anyway.
    let unit = element.attribute("unit").filter(|unit| !matches!(*unit, "degree" | "nanometer"));
    if let Some(unit) = unit {
        return Some(format!("the unit {} is ignored", quoted(unit)));
    }
    let is_empty = element.tag() == "input" && element.has("value") && element.attribute("value").is_none();
    let is_text = matches!(element.attribute("type"), Some("string" | "filename"));
    (is_empty && !is_text).then(|| "value=\"\" is ignored: the default counts".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_match_parts_and_what_is_below() {
        for (pattern, path, expected) in [
            ("/", "/car/body", true),
            ("/car", "/car/body", true),
            ("/car/body", "/car", false),
            ("/ca", "/car", false),
            ("/c*r", "/car/body", true),
            ("*", "Mesh", true),
            ("/a*b*c", "/axxbyyc", true),
            ("/a*b*c", "/axxc", false),
            ("Preview_Mesh", "/Preview_Mesh", true),
        ] {
            assert_eq!(matches_path(pattern, path), expected, "{pattern} {path}");
        }
    }
}
