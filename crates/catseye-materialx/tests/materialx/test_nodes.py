"""Our pattern nodes are MaterialX's own: ports, defaults, and values, which are compared with MaterialX's nodegraphs,
compiled by our reader, with its GLSL on Mesa, and with its generator's shaders at points of a surface."""

import collections
import itertools
import os
import pathlib
import tempfile
import time
import unittest

import MaterialX as mx
import numpy as np
import PIL.Image

import stock
from stock_inputs import PICTURE, positive, sample, wide
from support import missing, parse, report

TRIALS = 100
SURFACE_POINTS = 32
LIBRARY_TRIALS = 2
# Greatest difference from MaterialX's values, relative to those beyond 1. Nodegraphs run in our own arithmetic: what is
# left is another order of operations. GLSL promises no exact roundings either.
GRAPH_BOUND = 2e-5
GLSL_BOUND = 5e-6
# Graphs of some dozen nodes.
LIBRARY_BOUND = 5e-5
GLSL_BOUNDS = {
    # Mesa's polynomials for them are this far off.
    "acos": 5e-4,
    "asin": 5e-4,
    # The extinction is the root of a difference of large numbers.
    "artistic_ior": 2e-5,
}
# Definitions of which nothing but the type of what they are given says which one is meant.
TYPED_BY_INPUT = {"convert"}
# Matrices are the constants of transformmatrix here: nothing computes with them.
MATRICES = {"ND_extract_matrix33", "ND_extract_matrix44"}
# Categories whose values are compared in tests of our own, and why not with MaterialX.
ELSEWHERE = {
    "geompropvalue": "no mesh of ours has properties: its default",
    "image": "MaterialX leaves it to the texture unit",
    "swizzle": "MaterialX 1.39 no longer has it",
}
# What of MaterialX's library is not compared, and why.
NOT_COMPARED = {
    "UsdPrimvarReader": "no mesh of ours has properties",
    "tiledhexagons": "compares the root of a negative number",
}
# What of it is not read: graphs with constants that are matrices, and one that needs derivatives.
UNREAD = {"acescg_to_lin_rec709", "adobergb_to_lin_rec709", "bump", "g22_ap1_to_lin_rec709",
          "lin_adobergb_to_lin_rec709", "lin_displayp3_to_lin_rec709", "srgb_displayp3_to_lin_rec709"}


def by_graph(nodedef):
    return nodedef.getImplementation("genglsl").isA(mx.NodeGraph)


def by_glsl(nodedef):
    return stock.code(nodedef) is not None and nodedef.getNodeString() not in ELSEWHERE


def by_surface(nodedef):
    """What the generator writes itself: about geometry."""
    return not by_graph(nodedef) and stock.code(nodedef) is None and nodedef.getNodeString() not in ELSEWHERE


def difference(found, wanted):
    """The greatest, relative to numbers beyond 1."""
    return float((np.abs(found - wanted) / np.maximum(np.abs(wanted), 1.0)).max())


class Nodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if "OUTPUTS" not in os.environ:
            return
        cls.library = stock.library()
        cls.categories = stock.categories()
        patterns = [d for d in cls.library.getNodeDefs() if stock.is_pattern(d)]
        cls.nodedefs = [d for d in patterns if d.getNodeString() in cls.categories and d.getName() not in MATRICES]

    def setUp(self):
        if "OUTPUTS" not in os.environ:
            missing(self, "OUTPUTS does not name the example outputs")
        self.rng = np.random.default_rng(7)
        self.faults = collections.defaultdict(list)
        self.started = time.monotonic()

    def draw(self, nodedef, ports, trial, numbers=wide):
        return {port.getName(): sample(nodedef, port, self.rng, trial, numbers) for port in ports}

    def none_wrong(self, name, cases, nodedefs):
        categories = {d.getNodeString() for d in nodedefs}
        report(f"{name}: {cases} cases of {len(nodedefs)} definitions in {len(categories)} categories,",
               f"{time.monotonic() - self.started:.1f} s")
        lines = [f"{where}: {len(all_)} times, first {all_[0]}" for where, all_ in self.faults.items()]
        self.assertFalse(lines, "\n" + "\n".join(lines))

    def compare(self, nodedef, own, wanted, bound, values):
        """Notes a difference; returns it."""
        if isinstance(own, str) or isinstance(wanted, str):
            self.faults[nodedef.getName()].append([x for x in (own, wanted) if isinstance(x, str)][0])
            return 0.0
        if np.array_equal(own, wanted, equal_nan=True):
            return 0.0
        found = difference(own, wanted)
        if not found <= bound:
            inputs = {name: x if isinstance(x, str) else np.ravel(x).tolist() for name, x in values.items()}
            self.faults[nodedef.getName()].append(f"ours {own.tolist()}, theirs {wanted.tolist()}, inputs {inputs}")
        return found

    def test_values_of_graphs(self):
        """Each input is left out one time in five."""
        nodedefs = [d for d in self.nodedefs if by_graph(d)]
        bodies, cases = [], []
        for nodedef in nodedefs:
            copy, category = stock.renamed(nodedef)
            for trial in range(TRIALS):
                # The type of what is converted says which definition is meant.
                kept = lambda port: nodedef.getNodeString() in TYPED_BY_INPUT or self.rng.random() < 0.8
                values = self.draw(nodedef, filter(kept, nodedef.getActiveInputs()), trial)
                cases.append((nodedef, values))
                bodies += [stock.node(nodedef, values), copy + stock.node(nodedef, values, category)]
        with tempfile.TemporaryDirectory() as folder:
            picture = self.rng.integers(0, 256, (5, 7, 4), np.uint8)
            PIL.Image.fromarray(picture).save(pathlib.Path(folder) / PICTURE)
            found = stock.ours(bodies, folder=folder)
        for (nodedef, values), own, theirs in zip(cases, found[::2], found[1::2], strict=True):
            self.compare(nodedef, own, theirs, GRAPH_BOUND, values)
        self.none_wrong("graphs", len(cases), nodedefs)

    def test_defaults(self):
        """An input that is left out is MaterialX's default, or the geometry that it names, whatever the others are."""
        geometry = {"UV0": ("texcoord", "vector2", ""), "Pobject": ("position", "vector3", "object"),
                    "Nworld": ("normal", "vector3", "world"), "Tworld": ("tangent", "vector3", "world"),
                    "Bworld": ("bitangent", "vector3", "world"), "Vworld": ("viewdirection", "vector3", "world")}
        points = [stock.POINT, *self.rng.uniform(-1, 1, (3, 20)).tolist()]
        cases, bodies = [], []
        for nodedef in self.nodedefs:
            ports = nodedef.getActiveInputs()
            for port, trial in itertools.product(ports, range(4)):
                # Without it nothing says which definition is meant.
                if port.getType() == "filename" or nodedef.getNodeString() in TYPED_BY_INPUT:
                    continue
                others = [other for other in ports
                          if other.getName() != port.getName() and other.getType() != "filename"]
                values = self.draw(nodedef, others, trial)
                named = port.getAttribute("defaultgeomprop")
                given, before = {port.getName(): port.getValueString()}, ""
                if named:
                    category, kind, space = geometry[named]
                    space = f'<input name="space" type="string" value="{space}"/>' if space else ""
                    given = {port.getName(): f"@{category}"}
                    before = f'<{category} name="{category}" type="{kind}">{space}</{category}>'
                cases.append((nodedef, port.getName(), values))
                bodies += [stock.node(nodedef, values), before + stock.node(nodedef, values | given)]
        found = stock.ours(bodies, points)
        for (nodedef, name, values), without, given in zip(cases, found[::2], found[1::2], strict=True):
            if isinstance(without, str) or isinstance(given, str):
                self.faults[f"{nodedef.getName()} {name}"].append(without if isinstance(without, str) else given)
            elif not np.array_equal(without, given, equal_nan=True):
                fault = f"{without.tolist()}, given {given.tolist()}, others {values}"
                self.faults[f"{nodedef.getName()} {name}"].append(fault)
        self.none_wrong("defaults", len(cases), self.nodedefs)

    def test_ports(self):
        """The types that a category has, and its inputs and theirs, are MaterialX's, and no others."""
        wanted, ends = collections.defaultdict(set), {}
        for nodedef in self.nodedefs:
            kind = stock.kind(nodedef)
            wanted[nodedef.getNodeString(), kind] |= {(p.getName(), p.getType()) for p in nodedef.getActiveInputs()}
            ends[nodedef.getNodeString(), kind] = stock.ends(nodedef)
        values = {kind: ", ".join(["1"] * width) for kind, width in stock.WIDTHS.items()}
        values |= {"boolean": "true", "string": "x", "filename": ""}
        probes, bodies = [], []
        for category, kind in itertools.product(sorted(self.categories - {"swizzle"}), stock.KINDS):
            end = ends.get((category, kind), f'<output name="o" type="{kind}" nodename="p"/>')
            names = {name for name, _ in wanted[category, kind]}
            for name, given in [(None, None), *itertools.product([*sorted(names), "nonsense"], values)]:
                value = f'<input name="{name}" type="{given}" value="{values[given]}"/>' if name else ""
                probes.append((category, kind, name, given))
                bodies.append(f'<{category} name="p" type="{kind}">{value}</{category}>{end}')
        refusals = ("is of type", "no such input", "unknown node category", "a node of several outputs without")
        for (category, kind, name, given), own in zip(probes, stock.ours(bodies), strict=True):
            is_ours = not (isinstance(own, str) and any(refusal in own for refusal in refusals))
            known = (category, kind) in ends
            if not known or name is None:
                if is_ours != known:
                    self.faults[f"{category} {kind}"].append(f"{'is ours' if is_ours else 'is not ours'}, {own}")
            elif name != "nonsense":
                if is_ours != ((name, given) in wanted[category, kind]):
                    fault = f"{given} is {'' if is_ours else 'not '}ours, {own}"
                    self.faults[f"{category} {kind} {name}"].append(fault)
            elif given == "float":
                # MaterialX 1.38 had a space.
                names = {name for name, _ in wanted[category, kind]} | ({"space"} if category == "normalmap" else set())
                if set(own.partition(" has ")[2].split(", ")) - {""} != names:
                    self.faults[f"{category} {kind}"].append(own)
        self.none_wrong("ports", len(probes), self.nodedefs)

    def test_every_category_is_compared(self):
        compared = {d.getNodeString() for d in self.nodedefs if by_graph(d) or by_glsl(d) or by_surface(d)}
        self.assertEqual(self.categories - compared, set(ELSEWHERE))

    def test_values_of_swizzle(self):
        """Of MaterialX 1.38."""
        places = {"r": 0, "g": 1, "b": 2, "a": 3, "x": 0, "y": 1, "z": 2, "w": 3}
        cases, bodies = [], []
        kinds = ["float", "vector2", "color3", "vector3", "color4", "vector4"]
        for given, kind, _ in itertools.product(kinds, kinds, range(20)):
            values = np.float32(wide(stock.WIDTHS[given], self.rng))
            named = ("rgba" if given.startswith("color") else "xyzw")[:len(values)] + "01"
            channels = "".join(self.rng.choice(list(named), stock.WIDTHS[kind]))
            cases.append([int(c) if c in "01" else values[places[c]] for c in channels])
            fed = stock.fed(given, values)
            bodies.append(f'<swizzle name="p" type="{kind}"><input name="in" type="{given}" {fed}/>'
                          f'<input name="channels" type="string" value="{channels}"/></swizzle>'
                          f'<output name="o" type="{kind}" nodename="p"/>')
        for wanted, own, body in zip(cases, stock.ours(bodies), bodies, strict=True):
            self.assertFalse(isinstance(own, str), own)
            np.testing.assert_array_equal(own[0, 0, :len(wanted)], np.float32(wanted), body)

    def gpu(self):
        try:
            import stock_glsl
            return stock_glsl, stock_glsl.context()
        except Exception as error:  # noqa: BLE001 - no driver, no library: the reason is what counts
            return missing(self, f"no OpenGL: {error}")

    def test_values_of_glsl(self):
        module, context = self.gpu()
        nodedefs = [d for d in self.nodedefs if by_glsl(d)]
        cases, bodies = [], []
        for category in sorted({d.getNodeString() for d in nodedefs}):
            group = [d for d in nodedefs if d.getNodeString() == category]
            runner = module.Runner(context, group)
            for nodedef in group:
                # A string is a note: the code doesn't take it.
                ports = [port for port in nodedef.getActiveInputs() if port.getType() != "string"]
                drawn = [self.draw(nodedef, ports, trial) for trial in range(TRIALS)]
                theirs = runner.run(nodedef, [[values[port.getName()] for port in ports] for values in drawn])
                for row, values in enumerate(drawn):
                    cases.append((nodedef, values, theirs[:, row:row + 1]))
                    bodies.append(stock.node(nodedef, values))
        worst = collections.Counter()
        for (nodedef, values, theirs), own in zip(cases, stock.ours(bodies), strict=True):
            category = nodedef.getNodeString()
            found = self.compare(nodedef, own, theirs, GLSL_BOUNDS.get(category, GLSL_BOUND), values)
            worst[category] = max(worst[category], found)
        report("glsl on", context.info["GL_RENDERER"], "- greatest differences:",
               ", ".join(f"{name} {found:.1e}" for name, found in worst.most_common(8)))
        self.none_wrong("glsl", len(cases), nodedefs)

    def test_values_of_geometry(self):
        """At points of an object, for each enumeration's values."""
        module, context = self.gpu()
        surface = module.Surface(context, SURFACE_POINTS, self.rng)
        nodedefs = [d for d in self.nodedefs if by_surface(d)]
        cases = 0
        for nodedef in nodedefs:
            spaces = [("fromspace", "tospace"), ("space",)]
            names = next((names for names in spaces if nodedef.getActiveInput(names[0])), ())
            spaces = ["model", "object", "world"] + [""] * (len(names) == 2)
            for chosen in itertools.product(spaces, repeat=len(names)):
                ports = [port for port in nodedef.getActiveInputs() if port.getName() not in names]
                values = self.draw(nodedef, ports, 0) | dict(zip(names, chosen))
                body = stock.node(nodedef, values)
                document = parse(stock.document(body), self.library)
                theirs = surface.run(document.getOutput("o0"))
                [own] = stock.ours([body], surface.points)
                width = stock.WIDTHS[nodedef.getType()]
                if not isinstance(own, str):
                    own = own[0, :, :width]
                self.compare(nodedef, own, theirs[:, :width], GLSL_BOUND, values)
                cases += SURFACE_POINTS
        self.none_wrong("geometry", cases, nodedefs)

    def test_values_of_library(self):
        """Nodes that MaterialX's library defines as graphs and we don't build in, at points of an object."""
        module, context = self.gpu()
        surface = module.Surface(context, SURFACE_POINTS, self.rng)
        nodedefs = [d for d in self.library.getNodeDefs() if stock.is_pattern(d) and d.getImplementation("genglsl")
                    and by_graph(d) and d.getNodeString() not in self.categories | NOT_COMPARED.keys()
                    and all(port.getType() != "filename" for port in d.getActiveInputs())]
        folder = pathlib.Path(mx.getDefaultDataSearchPath().asString())
        cases, unread = [], set()
        for nodedef, trial in itertools.product(nodedefs, range(LIBRARY_TRIALS)):
            # Below 0 the GPU leaves much of it undefined, and jitter is an angle of 90,000 degrees.
            ports = [port for port in nodedef.getActiveInputs()
                     if not port.hasAttribute("defaultgeomprop") and port.getName() != "jitter"]
            values = self.draw(nodedef, ports, trial, positive)
            cases.append((nodedef, values, stock.node(nodedef, values)))
        found = stock.ours([body for _, _, body in cases], surface.points, folder)
        for (nodedef, values, body), own in zip(cases, found, strict=True):
            if isinstance(own, str):
                unread.add(nodedef.getNodeString())
                self.assertIn("its implementation is code for another renderer", own)
                continue
            document = parse(stock.document(body), self.library)
            for i, output in enumerate(stock.outputs(nodedef)):
                width = stock.WIDTHS[output.getType()]
                theirs = surface.run(document.getOutput(f"o{i}"))
                self.compare(nodedef, own[i, :, :width], theirs[:, :width], LIBRARY_BOUND, values)
        self.assertEqual(unread, UNREAD)
        self.none_wrong("library", len(cases) * SURFACE_POINTS, nodedefs)


if __name__ == "__main__":
    unittest.main()
