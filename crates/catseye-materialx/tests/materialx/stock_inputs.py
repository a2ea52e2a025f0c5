"""Random inputs for MaterialX's pattern nodes, where these are defined."""

import numpy as np

import stock

PICTURE = "picture.png"


def nonzero(shape, rng):
    return rng.choice([-1.0, 1.0], shape) * rng.uniform(0.1, 3.0, shape)


def positive(shape, rng):
    return rng.uniform(0.05, 3.0, shape)


def unit(shape, rng):
    return rng.uniform(0.0, 1.0, shape)


def signed_unit(shape, rng):
    return rng.uniform(-1.0, 1.0, shape)


def wide(shape, rng):
    """What most inputs get: ends, numbers between and beyond."""
    kinds = [np.zeros(shape), np.ones(shape), unit(shape, rng), rng.uniform(-3.0, 3.0, shape)]
    return np.choose(rng.choice(4, shape, p=[0.15, 0.1, 0.4, 0.35]), kinds)


# Inputs that GLSL or MaterialX leave undefined somewhere, and what is drawn in place of `wide`.
DOMAINS = {
    ("acos", "in"): signed_unit,
    ("artistic_ior", "edge_color"): unit,
    ("artistic_ior", "reflectivity"): unit,
    ("asin", "in"): signed_unit,
    ("atan2", "inx"): nonzero,
    ("clamp", "high"): positive,
    ("clamp", "low"): lambda shape, rng: -positive(shape, rng),
    ("divide", "in2"): nonzero,
    ("ln", "in"): positive,
    ("modulo", "in2"): nonzero,
    ("normalmap", "bitangent"): nonzero,
    ("normalmap", "in"): lambda shape, rng: unit(shape, rng) * rng.integers(0, 2),
    ("normalmap", "normal"): nonzero,
    ("normalmap", "tangent"): nonzero,
    ("normalize", "in"): nonzero,
    ("place2d", "scale"): nonzero,
    ("power", "in1"): positive,
    ("range", "gamma"): positive,
    ("range", "inhigh"): lambda shape, rng: 4.0 + unit(shape, rng),
    ("remap", "inhigh"): lambda shape, rng: 4.0 + unit(shape, rng),
    ("rotate3d", "axis"): nonzero,
    ("safepower", "in1"): nonzero,
    ("splitlr", "center"): positive,
    ("splittb", "center"): positive,
    ("sqrt", "in"): positive,
}


def sample(nodedef, port, rng, trial, numbers=wide):
    """A value for an input: each of an enumeration's in turn, else random."""
    category, name, kind = nodedef.getNodeString(), port.getName(), port.getType()
    choices = stock.choices(port)
    if choices:
        return choices[trial % len(choices)]
    if kind == "filename":
        return PICTURE
    if kind == "string":
        return ""
    width = stock.WIDTHS[kind]
    if kind == "boolean":
        return rng.integers(0, 2, width)
    if kind == "integer":
        if name == "index":
            held = {"texcoord": 1, "geomcolor": 1, "tangent": 1, "bitangent": 1}.get(category)
            return rng.integers(0, held or stock.WIDTHS[nodedef.getActiveInput("in").getType()], width)
        return rng.integers(0 if name == "octaves" else -2, 6, width)
    return DOMAINS.get((category, name), numbers)(width, rng)
