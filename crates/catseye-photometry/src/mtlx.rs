//! Fitted sheeting as a MaterialX document.

use std::io::Cursor;

use catseye::{Model, width};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use crate::colour::Colour;
use crate::digits::significant;
use crate::entrance::{EntranceLaw, LEAST_COSINE};
use crate::sheeting::{RetroLobe, Sheeting};

/// What a document says beside the numbers.
#[derive(Clone, Debug)]
pub struct MaterialText<'a> {
    /// Name of the material, as its user wants it; letters and digits remain, the rest becomes `_`.
    pub name: &'a str,
    /// What the material was fitted to, and how well.
    pub doc: &'a str,
    /// Comment at the head of the document.
    pub comment: &'a str,
    /// Colour of the lobes.
    pub colour: Colour,
    /// Colour of the diffuse base.
    pub base_colour: Colour,
}

/// How much of the tangent is added to the viewer's projection, which has no direction along the normal.
const TANGENT_SHARE: f64 = 1e-4;
/// The cosine that the laws see, as a node.
const COSINE: &str = "entrance_cosine";
/// The viewer's projection on the surface, as a node.
const PROJECTION: &str = "view_projection";

/// The sheeting as a MaterialX 1.39 document: lobes whose tints depend on the entrance angle, added to a
/// diffuse base, under a coat.
///
/// The nodes are those of MaterialX and `retro_reflective_bsdf`, in the back-vector model
/// `generalized_schlick_bsdf` with `retroreflective`. A lobe that keeps its width has `tangent_u` along the
/// viewer's projection and `roughness_u` over N.V.
#[must_use]
pub fn to_mtlx(sheeting: &Sheeting, text: &MaterialText<'_>) -> String {
    let mut document = Document::new(text.comment);
    let name = identifier(text.name);
    let graph = format!("{name}_sheet");
    document.open("nodegraph", &[("name", &graph)]);
    let tints = entrance_nodes(&mut document, sheeting);
    let mut parts = Vec::new();
    for (i, lobe) in sheeting.lobes.iter().enumerate() {
        let part = format!("lobe_{}", i + 1);
        let tint = document.tint(&part, rgb(text.colour, lobe.strength), tints[i].as_deref());
        match sheeting.model {
            Model::BackVector => document.back_vector(&part, lobe.roughness.map(width), &tint),
            _ if lobe.keeps_width(sheeting.model) => {
                document.retro_reflective_of_one_width(&part, lobe.roughness[0], &tint);
            }
            Model::Reciprocal | Model::Edwards => document.retro_reflective(&part, lobe.roughness, &tint),
        }
        parts.push(part);
    }
    if sheeting.diffuse > 0.0 {
        let color = ("color", "color3", Binding::Value(rgb(text.base_colour, sheeting.diffuse)));
        document.node("oren_nayar_diffuse_bsdf", "base", "BSDF", &[color]);
        parts.push("base".to_owned());
    }
    let mut sheet = sum(&mut document, &parts);
    if let Some(ior) = sheeting.coat_ior {
        let alpha = number(sheeting.coat_roughness);
        let inputs = [
            ("ior", "float", Binding::Value(number(ior))),
            ("roughness", "vector2", Binding::Value(format!("{alpha}, {alpha}"))),
            ("scatter_mode", "string", Binding::Value("R".to_owned())),
        ];
        document.node("dielectric_bsdf", "coat", "BSDF", &inputs);
        let inputs =
            [("top", "BSDF", Binding::Node("coat".to_owned())), ("base", "BSDF", Binding::Node(sheet))];
        document.node("layer", "coated", "BSDF", &inputs);
        sheet = "coated".to_owned();
    }
    document.leaf("output", &[("name", "out"), ("type", "BSDF"), ("nodename", &sheet)]);
    document.close("nodegraph");
    let surface = format!("{name}_surface");
    document.open("surface", &[("name", &surface), ("type", "surfaceshader")]);
    document.leaf("input", &[("name", "bsdf"), ("type", "BSDF"), ("nodegraph", &graph), ("output", "out")]);
    document.close("surface");
    document.open("surfacematerial", &[("name", &name), ("type", "material"), ("doc", text.doc)]);
    document.leaf("input", &[("name", "surfaceshader"), ("type", "surfaceshader"), ("nodename", &surface)]);
    document.close("surfacematerial");
    document.finish()
}

/// The nodes of the entrance laws and of the viewer's projection; for each lobe the name of what its tint is
/// multiplied with, where there is something.
fn entrance_nodes(document: &mut Document, sheeting: &Sheeting) -> Vec<Option<String>> {
    if sheeting.lobes.iter().any(|lobe| lobe.entrance.is_some()) {
        let forward = ("faceforward", "boolean", Binding::Value("true".to_owned()));
        document.node("facingratio", "facing", "float", &[forward]);
        document.node("max", COSINE, "float", &[in1("facing"), in2(LEAST_COSINE)]);
    }
    if sheeting.lobes.iter().any(|lobe| lobe.keeps_width(sheeting.model)) {
        document.view_projection();
    }
    let mut made: Vec<(EntranceLaw, bool, String)> = Vec::new();
    let mut tint = |lobe: &RetroLobe| {
        let law = lobe.entrance?;
        let over_cosine = lobe.keeps_width(sheeting.model);
        let known = made.iter().find(|(other, over, _)| (*other, *over) == (law, over_cosine));
        let known = known.map(|(.., name)| name.clone());
        Some(known.unwrap_or_else(|| {
            let name = format!("entrance_{}", made.len() + 1);
            let bend =
                made.iter().find(|(other, ..)| (other.bend, other.sharpness) == (law.bend, law.sharpness));
            document.entrance(&name, &law, over_cosine, bend.map(|(.., name)| name.as_str()));
            made.push((law, over_cosine, name.clone()));
            name
        }))
    };
    sheeting.lobes.iter().map(&mut tint).collect()
}

/// The sum of closures.
fn sum(document: &mut Document, parts: &[String]) -> String {
    let mut parts = parts.iter().enumerate();
    let mut total = parts.next().map(|(_, first)| first.clone()).unwrap_or_default();
    for (i, part) in parts {
        let name = format!("sum_{i}");
        let inputs = [("in1", "BSDF", Binding::Node(total)), ("in2", "BSDF", Binding::Node(part.clone()))];
        document.node("add", &name, "BSDF", &inputs);
        total = name;
    }
    total
}

/// Where a node's input comes from.
#[derive(Clone, Debug)]
pub(crate) enum Binding {
    Value(String),
    Node(String),
}

type Input<'a> = (&'a str, &'a str, Binding);

fn in1(node: &str) -> Input<'static> {
    ("in1", "float", Binding::Node(node.to_owned()))
}

fn in2_node(node: &str) -> Input<'static> {
    ("in2", "float", Binding::Node(node.to_owned()))
}

fn in2(value: f64) -> Input<'static> {
    ("in2", "float", Binding::Value(number(value)))
}

/// An XML document as it grows. Writing to memory can't fail.
pub(crate) struct Document {
    writer: Writer<Cursor<Vec<u8>>>,
}

impl Document {
    pub(crate) fn new(comment: &str) -> Self {
        let mut document = Self { writer: Writer::new_with_indent(Cursor::new(Vec::new()), b' ', 2) };
        document.event(Event::Decl(BytesDecl::new("1.0", None, None)));
        // Two hyphens would end the comment.
        let comment = format!(" {} ", comment.replace("--", "- -"));
        document.event(Event::Comment(BytesText::from_escaped(comment)));
        document.open("materialx", &[("version", "1.39"), ("colorspace", "lin_rec709")]);
        document
    }

    pub(crate) fn finish(mut self) -> String {
        self.close("materialx");
        let mut text = String::from_utf8_lossy(&self.writer.into_inner().into_inner()).into_owned();
        text.push('\n');
        text
    }

    fn event(&mut self, event: Event<'_>) {
        self.writer.write_event(event).unwrap_or_default();
    }

    fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        let start = quick_xml::events::BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.event(Event::Start(start));
    }

    fn close(&mut self, name: &str) {
        self.event(Event::End(quick_xml::events::BytesEnd::new(name)));
    }

    fn leaf(&mut self, name: &str, attributes: &[(&str, &str)]) {
        let start = quick_xml::events::BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.event(Event::Empty(start));
    }

    pub(crate) fn node(&mut self, category: &str, name: &str, kind: &str, inputs: &[Input<'_>]) {
        self.open(category, &[("name", name), ("type", kind)]);
        for (input, kind, feed) in inputs {
            let (key, value) = match feed {
                Binding::Value(value) => ("value", value),
                Binding::Node(node) => ("nodename", node),
            };
            self.leaf("input", &[("name", input), ("type", kind), (key, value)]);
        }
        self.close(category);
    }

    /// The direction to the viewer without what of it is along the normal; its sign does not matter to an
    /// ellipse.
    fn view_projection(&mut self) {
        let vector = |input: &'static str, node: &str| (input, "vector3", Binding::Node(node.to_owned()));
        let world = ("space", "string", Binding::Value("world".to_owned()));
        for (category, name) in
            [("viewdirection", "view"), ("normal", "normal_world"), ("tangent", "tangent_world")]
        {
            self.node(category, name, "vector3", std::slice::from_ref(&world));
        }
        self.node(
            "dotproduct",
            "view_cosine",
            "float",
            &[vector("in1", "view"), vector("in2", "normal_world")],
        );
        let cosine = ("in2", "float", Binding::Node("view_cosine".to_owned()));
        self.node("multiply", "view_along_normal", "vector3", &[vector("in1", "normal_world"), cosine]);
        let rest = [vector("in1", "view"), vector("in2", "view_along_normal")];
        self.node("subtract", "view_across_normal", "vector3", &rest);
        self.node(
            "multiply",
            "tangent_share",
            "vector3",
            &[vector("in1", "tangent_world"), in2(TANGENT_SHARE)],
        );
        let sum = [vector("in1", "view_across_normal"), vector("in2", "tangent_share")];
        self.node("add", "view_with_tangent", "vector3", &sum);
        self.node("normalize", PROJECTION, "vector3", &[vector("in", "view_with_tangent")]);
    }

    /// `(1 + ((1 / cosine^2 - 1) / bend)^(p/2))^(-q/p)`, or `cosine^q`; over the cosine where the lobe is
    /// made to keep its width. `bend` is the law whose bend is the same, where there is one.
    fn entrance(&mut self, name: &str, law: &EntranceLaw, over_cosine: bool, bend: Option<&str>) {
        let EntranceLaw { slope, bend: squared_tangent, sharpness } = *law;
        if law.is_power() {
            let power = if over_cosine { slope - 1.0 } else { slope };
            self.node("power", name, "float", &[in1(COSINE), in2(power)]);
            return;
        }
        let sum = format!("{}_sum", bend.unwrap_or(name));
        if bend.is_none() {
            let part = |part: &str| format!("{name}_{part}");
            let [square, inverse, tangent, share, positive, rise] =
                ["cosine2", "secant2", "tangent2", "share", "share_positive", "rise"].map(part);
            self.node("multiply", &square, "float", &[in1(COSINE), in2_node(COSINE)]);
            let one = ("in1", "float", Binding::Value("1".to_owned()));
            self.node("divide", &inverse, "float", &[one, in2_node(&square)]);
            self.node("subtract", &tangent, "float", &[in1(&inverse), in2(1.0)]);
            self.node("divide", &share, "float", &[in1(&tangent), in2(squared_tangent)]);
            // Rounding must not give a negative number to the power.
            self.node("max", &positive, "float", &[in1(&share), in2(0.0)]);
            self.node("power", &rise, "float", &[in1(&positive), in2(0.5 * sharpness)]);
            self.node("add", &sum, "float", &[in1(&rise), in2(1.0)]);
        }
        let exponent = in2(-slope / sharpness);
        if over_cosine {
            let law = format!("{name}_law");
            self.node("power", &law, "float", &[in1(&sum), exponent]);
            self.node("divide", name, "float", &[in1(&law), in2_node(COSINE)]);
        } else {
            self.node("power", name, "float", &[in1(&sum), exponent]);
        }
    }

    /// The tint of a lobe: a value, or a node that multiplies it with a factor.
    fn tint(&mut self, lobe: &str, color: String, factor: Option<&str>) -> Binding {
        let Some(factor) = factor else { return Binding::Value(color) };
        let name = format!("{lobe}_tint");
        let factor = ("in2", "float", Binding::Node(factor.to_owned()));
        self.node("multiply", &name, "color3", &[("in1", "color3", Binding::Value(color)), factor]);
        Binding::Node(name)
    }

    fn retro_reflective(&mut self, name: &str, [u, v]: [f64; 2], tint: &Binding) {
        let mut inputs = vec![("roughness_u", "float", Binding::Value(number(u)))];
        if v != u {
            inputs.push(("roughness_v", "float", Binding::Value(number(v))));
        }
        inputs.push(("tint", "color3", tint.clone()));
        self.node("retro_reflective_bsdf", name, "BSDF", &inputs);
    }

    /// The lobe whose angular width is the same at every entrance angle.
    fn retro_reflective_of_one_width(&mut self, name: &str, roughness: f64, tint: &Binding) {
        let along = format!("{name}_roughness_u");
        let value = ("in1", "float", Binding::Value(number(roughness)));
        self.node("divide", &along, "float", &[value, in2_node(COSINE)]);
        let inputs = [
            ("roughness_u", "float", Binding::Node(along)),
            ("roughness_v", "float", Binding::Value(number(roughness))),
            ("tint", "color3", tint.clone()),
            ("tangent_u", "vector3", Binding::Node(PROJECTION.to_owned())),
        ];
        self.node("retro_reflective_bsdf", name, "BSDF", &inputs);
    }

    /// Schlick's curve between two equal colours is no curve: the Fresnel factor is the tint.
    fn back_vector(&mut self, name: &str, [alpha_u, alpha_v]: [f64; 2], tint: &Binding) {
        let inputs = [
            ("color0", "color3", tint.clone()),
            ("color90", "color3", tint.clone()),
            ("roughness", "vector2", Binding::Value(format!("{}, {}", number(alpha_u), number(alpha_v)))),
            ("retroreflective", "boolean", Binding::Value("true".to_owned())),
            ("scatter_mode", "string", Binding::Value("R".to_owned())),
        ];
        self.node("generalized_schlick_bsdf", name, "BSDF", &inputs);
    }
}

fn rgb(colour: Colour, luminance: f64) -> String {
    // Energy is conserved to rounding; an input's range is not.
    colour.of_luminance(luminance).map(|x| number(x.min(1.0))).join(", ")
}

/// Six digits: a hundred times finer than any data sheet.
fn number(x: f64) -> String {
    significant(x, 6)
}

/// A MaterialX name: letters, digits and `_`, not beginning with a digit.
pub(crate) fn identifier(name: &str) -> String {
    let mut text = String::new();
    for character in name.chars() {
        let good = if character.is_ascii_alphanumeric() { character.to_ascii_lowercase() } else { '_' };
        if !(good == '_' && text.ends_with('_')) {
            text.push(good);
        }
    }
    let text = text.trim_matches('_');
    if text.starts_with(|first: char| first.is_ascii_alphabetic()) {
        text.to_owned()
    } else {
        format!("material_{text}").trim_end_matches('_').to_owned()
    }
}
