"""Runs the GLSL that three.js lights a MeshPhysicalMaterial with, for pairs of directions, on Mesa."""

import json
import pathlib
import tempfile

import moderngl
import numpy as np

from support import run

# Prints the chunks of three's shader and the properties of the material that a module exports.
SCRIPT = """
import { ShaderChunk, MeshPhysicalMaterial } from 'three';
const module = await import(process.argv[2]);
const [material] = Object.values(module).filter((value) => value instanceof MeshPhysicalMaterial);
const names = ['common', 'lights_physical_pars_fragment', 'lights_physical_fragment'];
console.log(JSON.stringify({
  chunks: Object.fromEntries(names.map((name) => [name, ShaderChunk[name]])),
  uniforms: {
    diffuse: material.color.toArray(), metalnessFactor: material.metalness, roughnessFactor: material.roughness,
    ior: material.ior, specularIntensity: material.specularIntensity,
    specularColor: material.specularColor.toArray(), retroreflectivity: material.retroreflectivity,
  },
}));
"""
HEAD = """#version 400
#define STANDARD
#define PHYSICAL
#define IOR
#define USE_SPECULAR
#define USE_RETROREFLECTION
#define texture2D texture
uniform vec3 diffuse, specularColor, wo, wi;
uniform float metalnessFactor, roughnessFactor, ior, specularIntensity, retroreflectivity;
const vec3 nonPerturbedNormal = vec3(0.0, 0.0, 1.0);
out vec4 color;
"""
# three compensates for multiple scattering with a table that it makes at run time; for lobes as narrow as sheeting's the
# factor is 1.
MAIN = """
void main() {
    vec4 diffuseColor = vec4(diffuse, 1.0);
    %s
    material.multiScatteringCompensation = vec3(1.0);
    IncidentLight light;
    light.color = vec3(1.0);
    light.direction = wi;
    light.visible = true;
    ReflectedLight reflected = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    RE_Direct_Physical(light, vec3(0.0), nonPerturbedNormal, wo, nonPerturbedNormal, material, reflected);
    color = vec4(reflected.directSpecular + reflected.directDiffuse, 1.0);
}
"""
VERTEX = "#version 400\nin vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }"
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


class Shader:
    def __init__(self, node, packages, module):
        with tempfile.TemporaryDirectory(dir=packages) as folder:
            for name, text in [("material.mjs", module), ("print.mjs", SCRIPT)]:
                (pathlib.Path(folder) / name).write_text(text)
            output, good = run(node, "print.mjs", "./material.mjs", cwd=folder)
        assert good, output
        said = json.loads(output)
        chunks = said["chunks"]
        source = "\n".join([HEAD, chunks["common"], chunks["lights_physical_pars_fragment"]])
        self.context = moderngl.create_standalone_context(backend="egl")
        main = MAIN % chunks["lights_physical_fragment"]
        self.program = self.context.program(vertex_shader=VERTEX, fragment_shader=source + main)
        for name, value in said["uniforms"].items():
            self.program[name] = tuple(value) if isinstance(value, list) else value
        triangle = self.context.buffer(np.array([-1, -1, 3, -1, -1, 3], np.float32).tobytes())
        self.triangle = self.context.vertex_array(self.program, [(triangle, "2f", "at")])
        self.target = self.context.texture((1, 1), 4, dtype="f4")
        self.context.framebuffer([self.target]).use()

    def r_a(self, rows):
        """R_A at pairs of observation and entrance angle in degrees: what is reflected is f times the light's cosine."""
        return np.array([self.reflected(*row) for row in rows])

    def reflected(self, observation, entrance):
        to = lambda degrees: np.array([-np.sin(np.radians(degrees)), 0.0, np.cos(np.radians(degrees))])
        wo, wi = to(entrance - observation), to(entrance)
        self.program["wo"], self.program["wi"] = tuple(wo), tuple(wi)
        self.triangle.render()
        return np.frombuffer(self.target.read(), np.float32)[:3] @ LUMINANCE * wo[2]
