"""Runs MaterialX's own GLSL of pattern nodes on Mesa: over rows of inputs, and at points of a surface."""

import html
import pathlib
import re

import MaterialX as mx
import moderngl
import numpy as np

import stock
from support import GENERATORS, gen_shader, search_path

VERTEX = "#version 400\nin vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }"
TYPES = {"boolean": "bool", "integer": "int", "float": "float", "vector2": "vec2", "color3": "vec3", "vector3": "vec3",
         "color4": "vec4", "vector4": "vec4", "matrix33": "mat3", "matrix44": "mat4"}
HEAD = """#version 400
uniform sampler2D rows;
uniform int chosen;
out vec4 found;
vec4 padded(float x) { return vec4(x, 0.0, 0.0, 0.0); }
vec4 padded(int x) { return padded(float(x)); }
vec4 padded(bool x) { return padded(x ? 1.0 : 0.0); }
vec4 padded(vec2 x) { return vec4(x, 0.0, 0.0); }
vec4 padded(vec3 x) { return vec4(x, 0.0); }
vec4 padded(vec4 x) { return x; }
// A row is two pixels square, so that derivatives are 0.
float number(int at) { return texelFetch(rows, ivec2(at, int(gl_FragCoord.x) / 2), 0).r; }
"""


def source(path, seen):
    """A file with what it includes, each once."""
    if path in seen:
        return ""
    seen.add(path)
    root = path.parents[2 if path.parent.name == "lib" else 1].parent

    def include(match):
        for folder in (path.parent, root, path.parents[1]):
            if (folder / match[1]).exists():
                return source((folder / match[1]).resolve(), seen)
        raise FileNotFoundError(match[1])

    return re.sub(r'#include "([^"]+)"', include, path.read_text()) + "\n"


def read(kind, at):
    """An input of this type from its place in a row, and the place after it."""
    width = stock.WIDTHS[kind]
    each = ", ".join(f"number({at + i})" for i in range(width))
    return {"boolean": f"({each} != 0.0)", "integer": f"int({each})"}.get(kind, f"{TYPES[kind]}({each})"), at + width


def call(nodedef, implementation):
    """GLSL statements that leave the outputs in o0, o1, ..."""
    lines, names, at = [], {}, 0
    for port in nodedef.getActiveInputs():
        kind, name = port.getType(), f"i_{port.getName()}"
        if kind == "string":
            continue
        value, at = read(kind, at)
        lines.append(f"{TYPES[kind]} {name} = {value};")
        names[port.getName()] = name
    ends = stock.outputs(nodedef)
    lines += [f"{TYPES[output.getType()]} o{i};" for i, output in enumerate(ends)]
    inline = implementation.getAttribute("sourcecode")
    if inline:
        expression = re.sub(r"{{(\w+)}}", lambda match: names[match[1]], html.unescape(inline)).rstrip("; ")
        lines.append(f"o0 = {expression};")
    else:
        arguments = [*names.values(), *(f"o{i}" for i in range(len(ends)))]
        lines.append(f"{implementation.getFunction()}({', '.join(arguments)});")
    return lines


def context():
    return moderngl.create_standalone_context(backend="egl")


class Runner:
    """The nodes of some definitions in one program."""

    def __init__(self, context, nodedefs):
        self.context, self.at, parts, arms, seen = context, {}, [], [], set()
        folder = pathlib.Path(mx.getDefaultDataSearchPath().asString()) / "libraries/stdlib/genglsl"
        parts.append(source((folder / "lib/mx_math.glsl").resolve(), seen))
        for nodedef in nodedefs:
            implementation = stock.code(nodedef)
            if implementation.getFile():
                path = pathlib.Path(implementation.getActiveSourceUri()).parent / implementation.getFile()
                parts.append(source(path.resolve(), seen))
            lines = call(nodedef, implementation)
            for i, _ in enumerate(stock.outputs(nodedef)):
                number = len(arms)
                self.at[nodedef.getName(), i] = number
                parts.append(f"void node_{number}() {{ {' '.join(lines)} found = padded(o{i}); }}\n")
                arms.append(f"case {number}: node_{number}(); break;")
        main = f"void main() {{ found = vec4(0.0); switch (chosen) {{ {' '.join(arms)} }} }}"
        self.program = context.program(vertex_shader=VERTEX, fragment_shader=HEAD + "".join(parts) + main)
        triangle = context.buffer(np.array([-1, -1, 3, -1, -1, 3], np.float32).tobytes())
        self.vertices = context.vertex_array(self.program, [(triangle, "2f", "at")])

    def run(self, nodedef, rows):
        """Outputs, rows and four numbers; a row has a value for each input."""
        rows = np.array([np.concatenate([stock.numbers(value) for value in row]) for row in rows])
        texture = self.context.texture((rows.shape[1], len(rows)), 1, rows.astype(np.float32).tobytes(), dtype="f4")
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        texture.use(0)
        target = self.context.texture((2 * len(rows), 2), 4, dtype="f4")
        self.context.framebuffer([target]).use()
        found = []
        for i, _ in enumerate(stock.outputs(nodedef)):
            self.program["chosen"] = self.at[nodedef.getName(), i]
            self.vertices.render()
            found.append(np.frombuffer(target.read(), np.float32).reshape(2, -1, 4)[0, ::2])
        texture.release()
        target.release()
        return np.stack(found)


# Where the origin of the object is, in the world, and the viewer.
ORIGIN = np.array([0.5, -2.0, 3.0])
VIEWER = np.array([4.0, 5.0, -6.0])


class Surface:
    """Points of an object that is moved, not turned: there all that a point of ours has can be told."""

    def __init__(self, context, count, rng):
        self.context, self.count = context, count
        normal, tangent = (self.unit(rng.normal(size=(count, 3))) for _ in range(2))
        tangent = self.unit(tangent - normal * (normal * tangent).sum(axis=1, keepdims=True))
        position, texcoord = rng.uniform(-3, 3, (count, 3)), rng.uniform(-2, 2, (count, 2))
        self.data = {"i_position": position, "i_normal": normal, "i_tangent": tangent, "i_color_0": np.ones((count, 4)),
                     "i_texcoord_0": np.concatenate([texcoord, np.zeros((count, 1))], axis=1)}
        self.data = {name: values.astype(np.float32) for name, values in self.data.items()}
        world, bitangent = position + ORIGIN, np.cross(normal, tangent)
        self.points = np.concatenate([world, position, normal, tangent, bitangent, texcoord, self.unit(world - VIEWER)],
                                     axis=1).astype(np.float32).astype(float).tolist()

    @staticmethod
    def unit(vectors):
        return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)

    def run(self, output):
        """What the generator's whole shader gives for an output of a document: points and four numbers."""
        generator = GENERATORS["glsl"].create()
        settings = gen_shader.GenContext(generator)
        settings.registerSourceCodeSearchPath(search_path())
        shader = generator.generate("shader", output, settings)
        place = ("float at = (float(gl_VertexID) + 0.5) * 2.0 / float(count) - 1.0;"
                 "gl_PointSize = 1.0; gl_Position = vec4(at, 0.0, 0.0, 1.0);")
        vertex = re.sub(r"gl_Position = [^;]+;", place, shader.getSourceCode("vertex"))
        vertex = vertex.replace("#version 400", "#version 400\nuniform int count;")
        program = self.context.program(vertex_shader=vertex, fragment_shader=shader.getSourceCode("pixel"))
        matrix = np.eye(4)
        matrix[3, :3] = ORIGIN
        inverse = np.linalg.inv(matrix)
        uniforms = {"count": self.count, "u_viewPosition": VIEWER, "u_worldMatrix": matrix,
                    "u_worldTransposeMatrix": matrix.T, "u_worldInverseMatrix": inverse,
                    "u_worldInverseTransposeMatrix": inverse.T}
        for name, value in uniforms.items():
            if name in program:
                program[name] = value if isinstance(value, int) else tuple(np.ravel(value))
        content = []
        for name, values in self.data.items():
            if name in program:
                width = program[name].dimension
                buffer = self.context.buffer(np.ascontiguousarray(values[:, :width]).tobytes())
                content.append((buffer, f"{width}f", name))
        target = self.context.texture((self.count, 1), 4, dtype="f4")
        self.context.framebuffer([target]).use()
        self.context.vertex_array(program, content).render(moderngl.POINTS, vertices=self.count)
        return np.frombuffer(target.read(), np.float32).reshape(-1, 4)
