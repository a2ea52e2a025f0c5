"""MaterialX's own definitions of pattern nodes, random inputs for them, and what our reader makes of such nodes."""

import os
import subprocess
import tempfile
import xml.etree.ElementTree as ET

import MaterialX as mx
import numpy as np

WIDTHS = {"boolean": 1, "integer": 1, "float": 1, "vector2": 2, "color3": 3, "vector3": 3, "color4": 4, "vector4": 4,
          "matrix33": 9, "matrix44": 16}
# The types of patterns.
KINDS = ["boolean", "integer", "float", "vector2", "color3", "vector3", "color4", "vector4", "multioutput"]
SEPARATOR = "\f"
# The origin of a plane, its texture coordinates (0.3, 0.7).
POINT = [0, 0, 0] * 2 + [0, 0, 1, 1, 0, 0, 0, 1, 0, 0.3, 0.7, 0, 0, -1]


def library():
    """MaterialX's definitions alone."""
    stock = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), stock)
    return stock


def outputs(nodedef):
    return nodedef.getActiveOutputs()


def is_pattern(nodedef):
    """Whether all that it gives are numbers that a pattern can have."""
    return all(output.getType() in KINDS for output in outputs(nodedef))


def kind(nodedef):
    """The type of its nodes."""
    return "multioutput" if len(outputs(nodedef)) > 1 else nodedef.getType()


def ends(nodedef):
    """Outputs of a document for all that its node p gives."""
    if kind(nodedef) != "multioutput":
        return f'<output name="o0" type="{nodedef.getType()}" nodename="p"/>'
    return "".join(f'<output name="o{i}" type="{output.getType()}" nodename="p" output="{output.getName()}"/>'
                   for i, output in enumerate(outputs(nodedef)))


def numbers(value):
    return [float(x) for x in (value.replace(",", " ").split() if isinstance(value, str) else value)]


def code(nodedef):
    """The implementation in GLSL; none where there is a nodegraph, or where the generator brings the code itself."""
    found = nodedef.getImplementation("genglsl")
    if found is None or found.isA(mx.NodeGraph) or not (found.getFile() or found.hasAttribute("sourcecode")):
        return None
    return found


def choices(port):
    """The values of an enumeration, as a document writes them; none where there is none."""
    if not port.hasAttribute("enum"):
        return []
    names, values = (port.getAttribute(name).replace(" ", "") for name in ("enum", "enumvalues"))
    if not values:
        return names.split(",")
    width = WIDTHS[port.getType()]
    each = values.split(",")
    return [", ".join(each[i:i + width]) for i in range(0, len(each), width)]


def fed(kind, value):
    """The attribute that gives an input its value, an f32 exactly; @n is the node n."""
    if isinstance(value, str):
        return f'nodename="{value[1:]}"' if value.startswith("@") else f'value="{value}"'
    if kind == "boolean":
        return f'value="{"true" if value[0] else "false"}"'
    if kind == "integer":
        return f'value="{int(value[0])}"'
    return f'value="{", ".join(repr(float(np.float32(x))) for x in value)}"'


def node(nodedef, values, category=None):
    """A document with one node, and an output for each of its own; `values` by the name of the input."""
    ports = {port.getName(): port for port in nodedef.getActiveInputs()}
    inputs = "".join(f'<input name="{name}" type="{ports[name].getType()}" {fed(ports[name].getType(), value)}/>'
                     for name, value in values.items())
    category = category or nodedef.getNodeString()
    return f'<{category} name="p" type="{kind(nodedef)}">{inputs}</{category}>{ends(nodedef)}'


def document(body):
    return f'<materialx version="1.39">{body}</materialx>'


def renamed(nodedef):
    """The definition and its nodegraph under a name that nobody has built in, and that name."""
    graph = nodedef.getImplementation("genglsl")
    copy = mx.createDocument()
    definition = copy.addNodeDef("ND_copy", "", f"copy_of_{nodedef.getNodeString()}")
    for output in definition.getOutputs():
        definition.removeOutput(output.getName())
    definition.copyContentFrom(nodedef)
    for name in list(definition.getAttributeNames()):
        if name not in ("node", "name"):
            definition.removeAttribute(name)
    definition.setNodeString(f"copy_of_{nodedef.getNodeString()}")
    body = copy.addNodeGraph("NG_copy")
    body.copyContentFrom(graph)
    body.setNodeDefString("ND_copy")
    options = mx.XmlWriteOptions()
    options.writeXIncludeEnable = False
    root = ET.fromstring(mx.writeToXmlString(copy, options))
    return "".join(ET.tostring(child, encoding="unicode") for child in root), definition.getNodeString()


def categories():
    """The categories that the reader has built in."""
    done = subprocess.run([os.environ["OUTPUTS"], "--categories"], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def ours(bodies, points=(POINT,), folder=""):
    """What the reader makes of each document: an array of outputs, points and four numbers, or what it says; `folder`
    has the pictures."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("".join(" ".join(map(repr, point)) + "\n" for point in points))
        file.flush()
        text = SEPARATOR.join(document(body) for body in bodies)
        done = subprocess.run([os.environ["OUTPUTS"], file.name], input=text, capture_output=True, text=True,
                              check=True, env=os.environ | {"MATERIALX_SEARCH_PATH": str(folder)})
    found = []
    for block in done.stdout.split(SEPARATOR)[:-1]:
        block = block.strip()
        if block.startswith("error: "):
            found.append(block)
        else:
            rows = np.array([line.split() for line in block.splitlines()], np.float32)
            found.append(rows.reshape(-1, len(points), 4))
    return found
