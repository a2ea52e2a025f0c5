//! The colour spaces that documents may name.

/// How a colour becomes linear Rec. 709: a transfer function for each channel, then a change of primaries.
#[derive(Debug)]
pub(crate) struct ColorSpace {
    /// The name in documents.
    pub(crate) name: &'static str,
    transfer: fn(f32) -> f32,
    primaries: Option<[[f32; 3]; 3]>,
}

impl ColorSpace {
    pub(crate) fn to_linear(&self, color: [f32; 3]) -> [f32; 3] {
        self.mix_primaries(color.map(self.transfer))
    }

    /// One channel without its transfer function.
    pub(crate) fn transfer(&self, x: f32) -> f32 {
        (self.transfer)(x)
    }

    /// Rec. 709 from the space's own primaries.
    pub(crate) fn mix_primaries(&self, linear: [f32; 3]) -> [f32; 3] {
        match &self.primaries {
            None => linear,
            Some(rows) => rows.map(|row| row.iter().zip(linear).map(|(m, x)| m * x).sum()),
        }
    }

    /// The space of this name.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        // Names of other versions of MaterialX.
        let name = match name {
            "gamma18" => "g18_rec709",
            "gamma22" => "g22_rec709",
            "gamma24" => "rec709_display",
            "lin_rec709_scene" => "lin_rec709",
            "lin_ap1" | "lin_ap1_scene" => "acescg",
            "srgb_rec709_scene" => "srgb_texture",
            name => name,
        };
        COLOR_SPACES.iter().find(|space| space.name == name)
    }
}

const fn space(name: &'static str, transfer: fn(f32) -> f32) -> ColorSpace {
    ColorSpace { name, transfer, primaries: None }
}

/// The colour spaces that documents may name.
pub(crate) const COLOR_SPACES: &[ColorSpace] = &[
    space("lin_rec709", |x| x),
    space("raw", |x| x),
    space("none", |x| x),
    space("srgb_texture", linear_from_srgb),
    space("g18_rec709", |x| x.max(0.0).powf(1.8)),
    space("g22_rec709", |x| x.max(0.0).powf(2.2)),
    space("rec709_display", |x| x.max(0.0).powf(2.4)),
    ColorSpace { name: "acescg", transfer: |x| x, primaries: Some(REC709_FROM_AP1) },
    ColorSpace { name: "g22_ap1", transfer: |x| x.max(0.0).powf(2.2), primaries: Some(REC709_FROM_AP1) },
    ColorSpace { name: "lin_adobergb", transfer: |x| x, primaries: Some(REC709_FROM_ADOBE) },
    ColorSpace { name: "adobergb", transfer: linear_from_adobe, primaries: Some(REC709_FROM_ADOBE) },
    ColorSpace { name: "lin_displayp3", transfer: |x| x, primaries: Some(REC709_FROM_P3) },
    ColorSpace { name: "srgb_displayp3", transfer: linear_from_srgb, primaries: Some(REC709_FROM_P3) },
];

/// From the primaries' chromaticities, with the Bradford adaptation from ACES white to D65.
const REC709_FROM_AP1: [[f32; 3]; 3] = [
    [1.705_051, -0.621_792, -0.083_259],
    [-0.130_256, 1.140_805, -0.010_548],
    [-0.024_003, -0.128_969, 1.152_972],
];
/// From the primaries' chromaticities; both have the white D65.
const REC709_FROM_ADOBE: [[f32; 3]; 3] =
    [[1.398_36, -0.398_36, 0.0], [0.0, 1.0, 0.0], [0.0, -0.042_93, 1.042_93]];
/// From the primaries' chromaticities; both have the white D65.
const REC709_FROM_P3: [[f32; 3]; 3] =
    [[1.224_94, -0.224_940, 0.0], [-0.042_057, 1.042_057, 0.0], [-0.019_638, -0.078_636, 1.098_274]];

/// Adobe RGB (1998), section 4.3.1.2: an exponent of 2 + 51/256.
fn linear_from_adobe(x: f32) -> f32 {
    x.max(0.0).powf(2.0 + 51.0 / 256.0)
}

/// IEC 61966-2-1, the sRGB transfer function.
pub(crate) fn linear_from_srgb(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}
