//! Pictures.

use super::{
    FLOATS, Inputs, NodeDef, formula,
    port::{Port, file, integer, same, texcoord, text, vector2, word},
};
use crate::program::{
    Expr, Op,
    texture::{Filter, Wrap},
};

/// The default first.
const FILTERS: &[&str] = &["linear", "closest", "cubic"];
const MODES: &[&str] = &["periodic", "constant", "clamp", "mirror"];
/// A picture is one frame here.
const FRAMES: [Port; 3] = [
    text("framerange"),
    integer("frameoffset", 0.0),
    word("frameendaction", &["constant", "clamp", "periodic", "mirror"]),
];

fn look_up<'p>(n: &Inputs<'p>, at: Expr<'p>, wrap: [Wrap; 2], default: Expr<'p>) -> Expr<'p> {
    let Some(texture) = n.texture("file") else { return default };
    let filter = if n.text("filtertype") == "closest" { Filter::Closest } else { Filter::Linear };
    n.op(Op::Image { texture, wrap, filter }, &[at, default])
}

pub(super) static NODES: &[NodeDef] = &[
    formula(
        "image",
        FLOATS,
        &[
            file("file"),
            text("layer"),
            same("default", 0.0),
            texcoord(),
            word("uaddressmode", MODES),
            word("vaddressmode", MODES),
            word("filtertype", FILTERS),
            FRAMES[0],
            FRAMES[1],
            FRAMES[2],
        ],
        |n| {
            let [default, at] = n.all();
            let wrap = ["uaddressmode", "vaddressmode"]
                .map(|name| Wrap::parse(n.text(name)).unwrap_or(Wrap::Periodic));
            look_up(n, at, wrap, default)
        },
    ),
    formula(
        "tiledimage",
        FLOATS,
        &[
            file("file"),
            same("default", 0.0),
            texcoord(),
            vector2("uvtiling", 1.0),
            vector2("uvoffset", 0.0),
            vector2("realworldimagesize", 1.0),
            vector2("realworldtilesize", 1.0),
            word("filtertype", FILTERS),
            FRAMES[0],
            FRAMES[1],
            FRAMES[2],
        ],
        |n| {
            let [default, at, tiling, offset, image_size, tile_size] = n.all();
            look_up(n, (at * tiling - offset) / image_size * tile_size, [Wrap::Periodic; 2], default)
        },
    ),
];
