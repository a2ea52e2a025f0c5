//! From pattern nodes to instructions.

use super::{Fallback, Signature};
use crate::{
    program::{
        Assembler, Geometry, Lanes, Op,
        texture::{Filter, Wrap},
    },
    value::Type,
};

/// What an input of a pattern node is.
#[derive(Clone, Debug)]
pub(crate) enum Operand {
    Register(u32),
    Text(String),
    Matrix([f32; 9]),
    /// A texture by its number; `None` where no file is named.
    Texture(Option<u32>),
}

/// Octaves of a fractal; more are below what a float can tell apart.
const MAX_OCTAVES: i32 = 16;

/// Makes instructions from nodes whose inputs are instructions already.
#[derive(Debug, Default)]
pub(crate) struct Lowering {
    pub(crate) assembler: Assembler,
}

/// The inputs of one node.
struct Arguments<'a> {
    signature: &'a Signature,
    operands: &'a [Operand],
}

impl Arguments<'_> {
    fn operand(&self, name: &str) -> Option<&Operand> {
        self.signature.input(name).and_then(|(index, _)| self.operands.get(index))
    }

    fn text(&self, name: &str) -> &str {
        match self.operand(name) {
            Some(Operand::Text(text)) => text,
            _ => "",
        }
    }
}

impl Lowering {
    pub(crate) fn fallback(&mut self, fallback: Fallback, width: u8) -> Operand {
        match fallback {
            Fallback::Number(x) => Operand::Register(self.number(x, width)),
            Fallback::Lanes(lanes) => Operand::Register(self.lanes(lanes, width)),
            Fallback::Geometry(geometry) => Operand::Register(self.geometry(geometry)),
            Fallback::Text(text) => Operand::Text(text.to_owned()),
        }
    }

    /// The same number in every component.
    pub(crate) fn number(&mut self, x: f32, width: u8) -> u32 {
        let mut lanes = [0.0; 4];
        lanes[..usize::from(width).min(4)].fill(x);
        self.lanes(lanes, width)
    }

    pub(crate) fn lanes(&mut self, lanes: Lanes, width: u8) -> u32 {
        self.assembler.push(Op::constant(lanes), width, &[])
    }

    pub(crate) fn geometry(&mut self, geometry: Geometry) -> u32 {
        let width = if geometry == Geometry::Texcoord { 2 } else { 3 };
        self.assembler.push(Op::Geometry(geometry), width, &[])
    }

    pub(crate) fn op(&mut self, op: Op, width: u8, sources: &[u32]) -> u32 {
        self.assembler.push(op, width, sources)
    }

    /// A float in every component.
    pub(crate) fn splat(&mut self, register: u32, width: u8) -> u32 {
        if width == 1 { register } else { self.op(Op::Splat, width, &[register]) }
    }

    fn extract(&mut self, register: u32, index: u8) -> u32 {
        self.op(Op::Extract(index), 1, &[register])
    }

    fn remap(&mut self, w: u8, x: u32, [in_low, in_high, out_low, out_high]: [u32; 4]) -> u32 {
        let above = self.op(Op::Subtract, w, &[x, in_low]);
        let range = self.op(Op::Subtract, w, &[in_high, in_low]);
        let share = self.op(Op::Divide, w, &[above, range]);
        let out_range = self.op(Op::Subtract, w, &[out_high, out_low]);
        let scaled = self.op(Op::Multiply, w, &[share, out_range]);
        self.op(Op::Add, w, &[out_low, scaled])
    }

    fn clamp(&mut self, w: u8, x: u32, low: u32, high: u32) -> u32 {
        let x = self.op(Op::Max, w, &[x, low]);
        self.op(Op::Min, w, &[x, high])
    }

    /// The registers of a node's outputs, in the signature's order; one where it has one output. `None` where a node is
    /// known but one of its settings is not.
    pub(crate) fn node(&mut self, signature: &Signature, ty: Type, operands: &[Operand]) -> Option<Vec<u32>> {
        let args = Arguments { signature, operands };
        let width = ty.width();
        if signature.outputs.is_empty() {
            return self.single(&args, ty, width).map(|register| vec![register]);
        }
        Some(self.several(&args))
    }

    fn register(&mut self, args: &Arguments<'_>, name: &str) -> u32 {
        match args.operand(name) {
            Some(Operand::Register(register)) => *register,
            _ => self.number(0.0, 1),
        }
    }

    fn constant(&mut self, args: &Arguments<'_>, name: &str) -> Option<Lanes> {
        let register = self.register(args, name);
        self.assembler.constant(register)
    }

    fn several(&mut self, args: &Arguments<'_>) -> Vec<u32> {
        match args.signature.category {
            "artistic_ior" => {
                let (r, g) = (self.register(args, "reflectivity"), self.register(args, "edge_color"));
                vec![self.op(Op::ArtisticIndex, 3, &[r, g]), self.op(Op::ArtisticExtinction, 3, &[r, g])]
            }
            // separate2, separate3 and separate4: the letter says which component.
            _ => {
                let x = self.register(args, "in");
                let index = |name: &str| match name.as_bytes().last() {
                    Some(b'r' | b'x') => 0,
                    Some(b'g' | b'y') => 1,
                    Some(b'b' | b'z') => 2,
                    _ => 3,
                };
                args.signature.outputs.iter().map(|(name, _)| self.extract(x, index(name))).collect()
            }
        }
    }

    fn single(&mut self, args: &Arguments<'_>, ty: Type, w: u8) -> Option<u32> {
        let category = args.signature.category;
        if let Some(op) = component_wise(category) {
            let inputs = args.signature.inputs.len();
            let registers: Vec<u32> =
                (0..inputs).map(|i| self.register(args, args.signature.inputs[i].name)).collect();
            return Some(self.op(op, w, &registers));
        }
        Some(match category {
            "constant" => self.register(args, "value"),
            "dot" | "transformpoint" | "transformvector" | "transformnormal" => self.register(args, "in"),
            "image" | "tiledimage" => return self.image(args, w),
            "texcoord" | "position" | "normal" | "tangent" | "bitangent" | "viewdirection" => {
                self.geometric(args, w)
            }
            "geompropvalue" => self.register(args, "default"),
            "geomcolor" => self.number(1.0, w),
            "time" | "frame" => self.number(0.0, w),
            "facingratio" => self.facing_ratio(args),
            "safepower" => {
                let (base, exponent) = (self.register(args, "in1"), self.register(args, "in2"));
                let sign = self.op(Op::Sign, w, &[base]);
                let base = self.op(Op::Abs, w, &[base]);
                let power = self.op(Op::Power, w, &[base, exponent]);
                self.op(Op::Multiply, w, &[sign, power])
            }
            "invert" => {
                let (x, amount) = (self.register(args, "in"), self.register(args, "amount"));
                self.op(Op::Subtract, w, &[amount, x])
            }
            "clamp" => {
                let [x, low, high] = ["in", "low", "high"].map(|name| self.register(args, name));
                self.clamp(w, x, low, high)
            }
            "mix" => {
                let [fg, bg, mix] = ["fg", "bg", "mix"].map(|name| self.register(args, name));
                self.op(Op::Mix, w, &[bg, fg, mix])
            }
            "remap" => {
                let x = self.register(args, "in");
                let range = ["inlow", "inhigh", "outlow", "outhigh"].map(|name| self.register(args, name));
                self.remap(w, x, range)
            }
            "range" => self.range(args, w),
            "contrast" => {
                let [x, amount, pivot] = ["in", "amount", "pivot"].map(|name| self.register(args, name));
                let offset = self.op(Op::Subtract, w, &[x, pivot]);
                let scaled = self.op(Op::Multiply, w, &[offset, amount]);
                self.op(Op::Add, w, &[scaled, pivot])
            }
            "trianglewave" => {
                let x = self.register(args, "in");
                let fract = self.op(Op::Fract, 1, &[x]);
                let half = self.number(0.5, 1);
                let centred = self.op(Op::Subtract, 1, &[fract, half]);
                let distance = self.op(Op::Abs, 1, &[centred]);
                self.op(Op::Subtract, 1, &[half, distance])
            }
            "plus" | "minus" | "difference" | "screen" | "overlay" | "burn" | "dodge" => self.blend(args, w),
            "inside" | "outside" => {
                let (x, mask) = (self.register(args, "in"), self.register(args, "mask"));
                let one = self.number(1.0, 1);
                let share = if category == "inside" { mask } else { self.op(Op::Subtract, 1, &[one, mask]) };
                let share = self.splat(share, w);
                self.op(Op::Multiply, w, &[x, share])
            }
            "ifgreater" | "ifgreatereq" | "ifequal" => {
                let [a, b, yes, no] =
                    ["value1", "value2", "in1", "in2"].map(|name| self.register(args, name));
                let op = match category {
                    "ifgreater" => Op::Greater,
                    "ifgreatereq" => Op::GreaterOrEqual,
                    _ => Op::Equal,
                };
                let condition = self.op(op, 1, &[a, b]);
                self.select(w, condition, yes, no)
            }
            "switch" => self.switch(args, w),
            "and" | "or" | "xor" | "not" => self.logic(args),
            "distance" => {
                let (a, b) = (self.register(args, "in1"), self.register(args, "in2"));
                let difference = self.op(Op::Subtract, 4, &[a, b]);
                self.op(Op::Length, 1, &[difference])
            }
            "magnitude" => {
                let x = self.register(args, "in");
                self.op(Op::Length, 1, &[x])
            }
            "reflect" => {
                let (x, n) = (self.register(args, "in"), self.register(args, "normal"));
                let cos = self.op(Op::Dot, 1, &[x, n]);
                let twice = self.op(Op::Add, 1, &[cos, cos]);
                let twice = self.splat(twice, 3);
                let along = self.op(Op::Multiply, 3, &[twice, n]);
                self.op(Op::Subtract, 3, &[x, along])
            }
            "rotate2d" => {
                let (x, degrees) = (self.register(args, "in"), self.register(args, "amount"));
                self.rotate_2d(x, degrees)
            }
            "rotate3d" => self.rotate_3d(args),
            "transformmatrix" => self.transform(args),
            "normalmap" => return self.normal_map(args),
            "luminance" => self.luminance(args, w),
            "hsvadjust" => self.adjust_hsv(args, w),
            "saturate" => {
                let (x, amount) = (self.register(args, "in"), self.register(args, "amount"));
                let grey = self.luminance(args, w);
                let amount = self.splat(amount, w);
                self.op(Op::Mix, w, &[grey, x, amount])
            }
            "extract" => {
                let index = self.constant(args, "index")?[0];
                let x = self.register(args, "in");
                self.extract(x, (index.clamp(0.0, 3.0)) as u8)
            }
            "convert" => self.convert(args, ty)?,
            "swizzle" => self.swizzle(args, w)?,
            "combine2" if w == 2 => self.combine(args, &["in1", "in2"], w),
            "combine2" => self.combine_vectors(args, ty),
            "combine3" => self.combine(args, &["in1", "in2", "in3"], w),
            "combine4" => self.combine(args, &["in1", "in2", "in3", "in4"], w),
            "ramplr" | "ramptb" | "ramp4" | "splitlr" | "splittb" => self.ramp(args, w),
            "place2d" => self.place_2d(args)?,
            "noise2d" | "noise3d" | "fractal2d" | "fractal3d" => self.noise(args, w)?,
            "worleynoise2d" | "worleynoise3d" => {
                if self.constant(args, "style")?[0] != 0.0 {
                    return None;
                }
                let jitter = self.register(args, "jitter");
                let (op, at) = if category == "worleynoise2d" {
                    (Op::Worley2, "texcoord")
                } else {
                    (Op::Worley3, "position")
                };
                let position = self.register(args, at);
                self.op(op, w, &[position, jitter])
            }
            "checkerboard" => self.checkerboard(args, w),
            "randomfloat" => {
                let [x, seed, low, high] = ["in", "seed", "min", "max"].map(|name| self.register(args, name));
                let key = self.op(Op::Combine, 2, &[x, seed]);
                let random = self.op(Op::Cell2, 1, &[key]);
                self.op(Op::Mix, 1, &[low, high, random])
            }
            "roughness_anisotropy" => self.roughness_anisotropy(args),
            "roughness_dual" => {
                let roughness = self.register(args, "roughness");
                let square = self.op(Op::Multiply, 2, &[roughness, roughness]);
                self.unit(square, 2)
            }
            _ => return None,
        })
    }

    /// Clamped to what roughnesses may be.
    fn unit(&mut self, x: u32, w: u8) -> u32 {
        let (low, high) = (self.number(0.0, w), self.number(1.0, w));
        self.clamp(w, x, low, high)
    }

    fn select(&mut self, w: u8, condition: u32, yes: u32, no: u32) -> u32 {
        match self.assembler.constant(condition) {
            Some([x, ..]) => {
                if x != 0.0 {
                    yes
                } else {
                    no
                }
            }
            None => self.op(Op::Select, w, &[condition, yes, no]),
        }
    }

    fn image(&mut self, args: &Arguments<'_>, w: u8) -> Option<u32> {
        let default = self.register(args, "default");
        let Some(Operand::Texture(Some(texture))) = args.operand("file") else { return Some(default) };
        let texture = *texture;
        let filter = match args.text("filtertype") {
            "closest" => Filter::Closest,
            _ => Filter::Linear,
        };
        let mut at = self.register(args, "texcoord");
        let mut wrap = [Wrap::Periodic; 2];
        if args.signature.category == "image" {
            wrap = [Wrap::parse(args.text("uaddressmode"))?, Wrap::parse(args.text("vaddressmode"))?];
        } else {
            let [tiling, offset, image_size, tile_size] =
                ["uvtiling", "uvoffset", "realworldimagesize", "realworldtilesize"]
                    .map(|name| self.register(args, name));
            at = self.op(Op::Multiply, 2, &[at, tiling]);
            at = self.op(Op::Subtract, 2, &[at, offset]);
            at = self.op(Op::Divide, 2, &[at, image_size]);
            at = self.op(Op::Multiply, 2, &[at, tile_size]);
        }
        Some(self.op(Op::Image { texture, wrap, filter }, w, &[at, default]))
    }

    fn geometric(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let geometry = match (args.signature.category, args.text("space")) {
            ("texcoord", _) => Geometry::Texcoord,
            ("position", "world") => Geometry::Position,
            ("position", _) => Geometry::PositionObject,
            ("normal", _) => Geometry::Normal,
            ("tangent", _) => Geometry::Tangent,
            ("bitangent", _) => Geometry::Bitangent,
            _ => Geometry::View,
        };
        let register = self.geometry(geometry);
        if w == 3 && geometry == Geometry::Texcoord {
            let zero = self.number(0.0, 3);
            return self.op(Op::Add, 3, &[register, zero]);
        }
        register
    }

    fn facing_ratio(&mut self, args: &Arguments<'_>) -> u32 {
        let [view, normal, forward, invert] =
            ["viewdirection", "normal", "faceforward", "invert"].map(|name| self.register(args, name));
        let (zero, one) = (self.number(0.0, 1), self.number(1.0, 1));
        let cos = self.op(Op::Dot, 1, &[view, normal]);
        let away = self.op(Op::Subtract, 1, &[zero, cos]);
        let absolute = self.op(Op::Abs, 1, &[cos]);
        let facing = self.select(1, forward, absolute, away);
        let inverted = self.op(Op::Subtract, 1, &[one, facing]);
        self.select(1, invert, inverted, facing)
    }

    fn range(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let [x, in_low, in_high, gamma, out_low, out_high, clamp] =
            ["in", "inlow", "inhigh", "gamma", "outlow", "outhigh", "doclamp"]
                .map(|name| self.register(args, name));
        let (zero, one) = (self.number(0.0, w), self.number(1.0, w));
        let share = self.remap(w, x, [in_low, in_high, zero, one]);
        let exponent = self.op(Op::Divide, w, &[one, gamma]);
        let sign = self.op(Op::Sign, w, &[share]);
        let size = self.op(Op::Abs, w, &[share]);
        let power = self.op(Op::Power, w, &[size, exponent]);
        let bent = self.op(Op::Multiply, w, &[sign, power]);
        let result = self.remap(w, bent, [zero, one, out_low, out_high]);
        let clamped = self.clamp(w, result, out_low, out_high);
        self.select(w, clamp, clamped, result)
    }

    fn blend(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let [fg, bg, mix] = ["fg", "bg", "mix"].map(|name| self.register(args, name));
        let one = self.number(1.0, w);
        let blended = match args.signature.category {
            "plus" => self.op(Op::Add, w, &[bg, fg]),
            "minus" => self.op(Op::Subtract, w, &[bg, fg]),
            "difference" => {
                let difference = self.op(Op::Subtract, w, &[bg, fg]);
                self.op(Op::Abs, w, &[difference])
            }
            "screen" => self.screen(w, fg, bg),
            "overlay" => {
                let double = self.op(Op::Add, w, &[fg, fg]);
                let dark = self.op(Op::Multiply, w, &[double, bg]);
                let rest = self.op(Op::Subtract, w, &[double, one]);
                let light = self.screen(w, rest, bg);
                // Dark where the foreground is below one half, decided for each component.
                let half = self.number(0.5, w);
                let above = self.op(Op::Subtract, w, &[fg, half]);
                let sign = self.op(Op::Sign, w, &[above]);
                let (zero, one) = (self.number(0.0, w), self.number(1.0, w));
                let share = self.clamp(w, sign, zero, one);
                self.op(Op::Mix, w, &[dark, light, share])
            }
            "burn" => {
                let rest = self.op(Op::Subtract, w, &[one, bg]);
                let ratio = self.op(Op::Divide, w, &[rest, fg]);
                self.op(Op::Subtract, w, &[one, ratio])
            }
            // dodge
            _ => {
                let rest = self.op(Op::Subtract, w, &[one, fg]);
                self.op(Op::Divide, w, &[bg, rest])
            }
        };
        let mix = self.splat(mix, w);
        self.op(Op::Mix, w, &[bg, blended, mix])
    }

    fn screen(&mut self, w: u8, a: u32, b: u32) -> u32 {
        let one = self.number(1.0, w);
        let (a, b) = (self.op(Op::Subtract, w, &[one, a]), self.op(Op::Subtract, w, &[one, b]));
        let product = self.op(Op::Multiply, w, &[a, b]);
        self.op(Op::Subtract, w, &[one, product])
    }

    fn switch(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let which = self.register(args, "which");
        let mut result = self.number(0.0, w);
        for i in (1..=10).rev() {
            let option = self.register(args, &format!("in{i}"));
            let (low, high) = (self.number((i - 1) as f32, 1), self.number(i as f32, 1));
            let reached = self.op(Op::GreaterOrEqual, 1, &[which, low]);
            let passed = self.op(Op::GreaterOrEqual, 1, &[which, high]);
            let inside = self.op(Op::Subtract, 1, &[reached, passed]);
            result = self.select(w, inside, option, result);
        }
        result
    }

    fn logic(&mut self, args: &Arguments<'_>) -> u32 {
        let one = self.number(1.0, 1);
        if args.signature.category == "not" {
            let x = self.register(args, "in");
            return self.op(Op::Subtract, 1, &[one, x]);
        }
        let (a, b) = (self.register(args, "in1"), self.register(args, "in2"));
        match args.signature.category {
            "and" => self.op(Op::Min, 1, &[a, b]),
            "or" => self.op(Op::Max, 1, &[a, b]),
            _ => {
                let difference = self.op(Op::Subtract, 1, &[a, b]);
                self.op(Op::Abs, 1, &[difference])
            }
        }
    }

    fn sine_cosine(&mut self, degrees: u32) -> [u32; 2] {
        let factor = self.number(core::f32::consts::PI / 180.0, 1);
        let angle = self.op(Op::Multiply, 1, &[degrees, factor]);
        [self.op(Op::Sin, 1, &[angle]), self.op(Op::Cos, 1, &[angle])]
    }

    /// Clockwise, as MaterialX rotates: what is seen turns counter-clockwise.
    fn rotate_2d(&mut self, v: u32, degrees: u32) -> u32 {
        let [sin, cos] = self.sine_cosine(degrees);
        let zero = self.number(0.0, 1);
        let minus_sin = self.op(Op::Subtract, 1, &[zero, sin]);
        let [row_x, row_y] = [[cos, sin], [minus_sin, cos]].map(|row| self.op(Op::Combine, 2, &row));
        let rotated = [row_x, row_y].map(|row| self.op(Op::Dot, 1, &[row, v]));
        self.op(Op::Combine, 2, &rotated)
    }

    /// Rodrigues' formula.
    fn rotate_3d(&mut self, args: &Arguments<'_>) -> u32 {
        let [v, degrees, axis] = ["in", "amount", "axis"].map(|name| self.register(args, name));
        let axis = self.op(Op::Normalize, 3, &[axis]);
        let [sin, cos] = self.sine_cosine(degrees);
        let one = self.number(1.0, 1);
        let rest = self.op(Op::Subtract, 1, &[one, cos]);
        let along = self.op(Op::Dot, 1, &[axis, v]);
        let across = self.op(Op::Cross, 3, &[v, axis]);
        let share = self.op(Op::Multiply, 1, &[along, rest]);
        let [sin, cos, share] = [sin, cos, share].map(|x| self.splat(x, 3));
        let turned = self.op(Op::Multiply, 3, &[v, cos]);
        let sideways = self.op(Op::Multiply, 3, &[across, sin]);
        let kept = self.op(Op::Multiply, 3, &[axis, share]);
        let sum = self.op(Op::Add, 3, &[turned, sideways]);
        self.op(Op::Add, 3, &[sum, kept])
    }

    /// A row vector times the matrix, as MaterialX means it.
    fn transform(&mut self, args: &Arguments<'_>) -> u32 {
        let x = self.register(args, "in");
        let Some(Operand::Matrix(m)) = args.operand("mat") else { return x };
        let columns = [0, 1, 2].map(|i| [m[i], m[3 + i], m[6 + i], 0.0]);
        let dots = columns.map(|column| {
            let column = self.lanes(column, 3);
            self.op(Op::Dot, 1, &[x, column])
        });
        self.op(Op::Combine, 3, &dots)
    }

    fn normal_map(&mut self, args: &Arguments<'_>) -> Option<u32> {
        if args.text("space") != "tangent" {
            return None;
        }
        let [x, scale, normal, tangent, bitangent] =
            ["in", "scale", "normal", "tangent", "bitangent"].map(|name| self.register(args, name));
        let (two, one) = (self.number(2.0, 3), self.number(1.0, 3));
        let doubled = self.op(Op::Multiply, 3, &[x, two]);
        let offset = self.op(Op::Subtract, 3, &[doubled, one]);
        let mut sum = None;
        for (i, axis) in [tangent, bitangent, normal].into_iter().enumerate() {
            let mut share = self.extract(offset, i as u8);
            if i < 2 {
                let scale = self.normal_scale(scale, args, i as u8);
                share = self.op(Op::Multiply, 1, &[share, scale]);
            }
            let share = self.splat(share, 3);
            let part = self.op(Op::Multiply, 3, &[axis, share]);
            sum = Some(sum.map_or(part, |sum| self.op(Op::Add, 3, &[sum, part])));
        }
        Some(self.op(Op::Normalize, 3, &[sum?]))
    }

    /// A float scales both directions.
    fn normal_scale(&mut self, scale: u32, args: &Arguments<'_>, index: u8) -> u32 {
        let is_vector = args.operand("scale").is_some_and(|_| self.assembler.width(scale) > 1);
        if is_vector { self.extract(scale, index) } else { scale }
    }

    fn luminance(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let (x, weights) = (self.register(args, "in"), self.register(args, "lumacoeffs"));
        let sum = self.op(Op::Dot, 1, &[x, weights]);
        let grey = self.splat(sum, 3);
        if w < 4 { grey } else { self.with_alpha_of(grey, x) }
    }

    fn with_alpha_of(&mut self, color: u32, x: u32) -> u32 {
        let parts =
            [self.extract(color, 0), self.extract(color, 1), self.extract(color, 2), self.extract(x, 3)];
        self.op(Op::Combine, 4, &parts)
    }

    fn adjust_hsv(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let (x, amount) = (self.register(args, "in"), self.register(args, "amount"));
        let hsv = self.op(Op::RgbToHsv, w, &[x]);
        let hue = [hsv, amount].map(|v| self.extract(v, 0));
        let hue = self.op(Op::Add, 1, &hue);
        let [saturation, value] = [1, 2].map(|i| {
            let pair = [hsv, amount].map(|v| self.extract(v, i));
            self.op(Op::Multiply, 1, &pair)
        });
        let alpha = self.extract(hsv, 3);
        let adjusted = self.op(Op::Combine, w, &[hue, saturation, value, alpha][..usize::from(w)]);
        self.op(Op::HsvToRgb, w, &[adjusted])
    }

    /// One number becomes all components; a colour gains an alpha of 1; else components are dropped or 0.
    fn convert(&mut self, args: &Arguments<'_>, ty: Type) -> Option<u32> {
        let x = self.register(args, "in");
        let (from, to) = (self.assembler.width(x), ty.width());
        if from == 1 {
            return Some(match ty {
                Type::Boolean => {
                    let zero = self.number(0.0, 1);
                    let is_zero = self.op(Op::Equal, 1, &[x, zero]);
                    let one = self.number(1.0, 1);
                    self.op(Op::Subtract, 1, &[one, is_zero])
                }
                Type::Integer => self.op(Op::Floor, 1, &[x]),
                _ => self.splat(x, to),
            });
        }
        if from == 3 && to == 4 {
            let mut parts = [0, 1, 2, 3].map(|i| self.extract(x, i));
            parts[3] = self.number(1.0, 1);
            return Some(self.op(Op::Combine, 4, &parts));
        }
        let zero = self.number(0.0, to);
        Some(self.op(Op::Add, to, &[x, zero]))
    }

    fn swizzle(&mut self, args: &Arguments<'_>, w: u8) -> Option<u32> {
        let x = self.register(args, "in");
        let channels = args.text("channels").to_owned();
        let mut parts = Vec::new();
        for channel in channels.chars().take(usize::from(w)) {
            parts.push(match channel {
                'r' | 'x' => self.extract(x, 0),
                'g' | 'y' => self.extract(x, 1),
                'b' | 'z' => self.extract(x, 2),
                'a' | 'w' => self.extract(x, 3),
                '0' => self.number(0.0, 1),
                '1' => self.number(1.0, 1),
                _ => return None,
            });
        }
        if parts.len() != usize::from(w) {
            return None;
        }
        Some(if w == 1 { parts[0] } else { self.op(Op::Combine, w, &parts) })
    }

    fn combine(&mut self, args: &Arguments<'_>, names: &[&str], w: u8) -> u32 {
        let parts: Vec<u32> = names.iter().map(|name| self.register(args, name)).collect();
        self.op(Op::Combine, w, &parts)
    }

    /// A colour and its alpha, a vector3 and a float, or two vector2.
    fn combine_vectors(&mut self, args: &Arguments<'_>, ty: Type) -> u32 {
        let (a, b) = (self.register(args, "in1"), self.register(args, "in2"));
        let split = if self.assembler.width(a) == 2 { 2 } else { 3 };
        let parts: Vec<u32> = (0..4_u8)
            .map(|i| if i < split { self.extract(a, i) } else { self.extract(b, i - split) })
            .collect();
        self.op(Op::Combine, ty.width(), &parts)
    }

    fn ramp(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let uv = self.register(args, "texcoord");
        let [zero, one] = [0.0, 1.0].map(|x| self.number(x, 2));
        let inside = self.clamp(2, uv, zero, one);
        let [u, v] = [0, 1].map(|i| self.extract(inside, i));
        let mix = |lowering: &mut Self, a: u32, b: u32, t: u32| {
            let t = lowering.splat(t, w);
            lowering.op(Op::Mix, w, &[a, b, t])
        };
        match args.signature.category {
            "ramplr" => {
                let (left, right) = (self.register(args, "valuel"), self.register(args, "valuer"));
                mix(self, left, right, u)
            }
            "ramptb" => {
                let (top, bottom) = (self.register(args, "valuet"), self.register(args, "valueb"));
                mix(self, bottom, top, v)
            }
            "ramp4" => {
                let [tl, tr, bl, br] =
                    ["valuetl", "valuetr", "valuebl", "valuebr"].map(|name| self.register(args, name));
                let (top, bottom) = (mix(self, tl, tr, u), mix(self, bl, br, u));
                mix(self, bottom, top, v)
            }
            split => {
                let [first, second, at] = if split == "splitlr" {
                    [self.register(args, "valuel"), self.register(args, "valuer"), self.extract(uv, 0)]
                } else {
                    [self.register(args, "valueb"), self.register(args, "valuet"), self.extract(uv, 1)]
                };
                let centre = self.register(args, "center");
                let beyond = self.op(Op::GreaterOrEqual, 1, &[at, centre]);
                self.select(w, beyond, second, first)
            }
        }
    }

    fn place_2d(&mut self, args: &Arguments<'_>) -> Option<u32> {
        let [uv, pivot, scale, degrees, offset] =
            ["texcoord", "pivot", "scale", "rotate", "offset"].map(|name| self.register(args, name));
        let translate_first = self.constant(args, "operationorder")?[0] != 0.0;
        let mut at = self.op(Op::Subtract, 2, &[uv, pivot]);
        if translate_first {
            at = self.op(Op::Subtract, 2, &[at, offset]);
            at = self.rotate_2d(at, degrees);
            at = self.op(Op::Divide, 2, &[at, scale]);
        } else {
            at = self.op(Op::Divide, 2, &[at, scale]);
            at = self.rotate_2d(at, degrees);
            at = self.op(Op::Subtract, 2, &[at, offset]);
        }
        Some(self.op(Op::Add, 2, &[at, pivot]))
    }

    fn noise(&mut self, args: &Arguments<'_>, w: u8) -> Option<u32> {
        let category = args.signature.category;
        let (op, at) =
            if category.ends_with("2d") { (Op::Noise2, "texcoord") } else { (Op::Noise3, "position") };
        let width = if at == "texcoord" { 2 } else { 3 };
        let mut at = self.register(args, at);
        let amplitude = self.register(args, "amplitude");
        let amplitude =
            if self.assembler.width(amplitude) == 1 { self.splat(amplitude, w) } else { amplitude };
        if category.starts_with("noise") {
            let pivot = self.register(args, "pivot");
            let pivot = self.splat(pivot, w);
            let noise = self.op(op, w, &[at]);
            let scaled = self.op(Op::Multiply, w, &[noise, amplitude]);
            return Some(self.op(Op::Add, w, &[scaled, pivot]));
        }
        let octaves = (self.constant(args, "octaves")?[0] as i32).clamp(0, MAX_OCTAVES);
        let (lacunarity, diminish) = (self.register(args, "lacunarity"), self.register(args, "diminish"));
        let (lacunarity, diminish) = (self.splat(lacunarity, width), self.splat(diminish, w));
        let (mut sum, mut share) = (self.number(0.0, w), self.number(1.0, w));
        for _ in 0..octaves {
            let noise = self.op(op, w, &[at]);
            let part = self.op(Op::Multiply, w, &[noise, share]);
            sum = self.op(Op::Add, w, &[sum, part]);
            share = self.op(Op::Multiply, w, &[share, diminish]);
            at = self.op(Op::Multiply, width, &[at, lacunarity]);
        }
        Some(self.op(Op::Multiply, w, &[sum, amplitude]))
    }

    fn checkerboard(&mut self, args: &Arguments<'_>, w: u8) -> u32 {
        let [first, second, tiling, offset, uv] =
            ["color1", "color2", "uvtiling", "uvoffset", "texcoord"].map(|name| self.register(args, name));
        let scaled = self.op(Op::Multiply, 2, &[uv, tiling]);
        let moved = self.op(Op::Subtract, 2, &[scaled, offset]);
        let cell = self.op(Op::Floor, 2, &[moved]);
        let ones = self.number(1.0, 2);
        let sum = self.op(Op::Dot, 1, &[cell, ones]);
        let two = self.number(2.0, 1);
        let odd = self.op(Op::Modulo, 1, &[sum, two]);
        self.select(w, odd, second, first)
    }

    /// Alpha along and across the tangent, from Kulla and Conty's anisotropy.
    fn roughness_anisotropy(&mut self, args: &Arguments<'_>) -> u32 {
        let (roughness, anisotropy) = (self.register(args, "roughness"), self.register(args, "anisotropy"));
        let (zero, one, most) = (self.number(0.0, 1), self.number(1.0, 1), self.number(0.98, 1));
        let alpha = self.op(Op::Multiply, 1, &[roughness, roughness]);
        let alpha = self.unit(alpha, 1);
        let anisotropy = self.clamp(1, anisotropy, zero, most);
        let rest = self.op(Op::Subtract, 1, &[one, anisotropy]);
        let aspect = self.op(Op::Sqrt, 1, &[rest]);
        let along = self.op(Op::Divide, 1, &[alpha, aspect]);
        let along = self.op(Op::Min, 1, &[along, one]);
        let across = self.op(Op::Multiply, 1, &[alpha, aspect]);
        self.op(Op::Combine, 2, &[along, across])
    }
}

/// The operation of nodes that hand their inputs to it in order.
fn component_wise(category: &str) -> Option<Op> {
    Some(match category {
        "add" => Op::Add,
        "subtract" => Op::Subtract,
        "multiply" => Op::Multiply,
        "divide" => Op::Divide,
        "modulo" => Op::Modulo,
        "power" => Op::Power,
        "min" => Op::Min,
        "max" => Op::Max,
        "absval" => Op::Abs,
        "sign" => Op::Sign,
        "floor" => Op::Floor,
        "ceil" => Op::Ceil,
        "round" => Op::Round,
        "fract" => Op::Fract,
        "sqrt" => Op::Sqrt,
        "sin" => Op::Sin,
        "cos" => Op::Cos,
        "tan" => Op::Tan,
        "asin" => Op::Asin,
        "acos" => Op::Acos,
        "ln" => Op::Ln,
        "exp" => Op::Exp,
        "atan2" => Op::Atan2,
        "smoothstep" => Op::Smoothstep,
        "normalize" => Op::Normalize,
        "dotproduct" => Op::Dot,
        "crossproduct" => Op::Cross,
        "rgbtohsv" => Op::RgbToHsv,
        "hsvtorgb" => Op::HsvToRgb,
        "cellnoise2d" => Op::Cell2,
        "cellnoise3d" => Op::Cell3,
        _ => return None,
    })
}
