"""Runs functions of a generated GLSL pixel shader over rows of numbers, one pixel for each, on Mesa."""

import moderngl
import numpy as np

from support import data_library, generate, parse, stages

DOCUMENT = """<?xml version="1.0"?><materialx version="1.39">
<retro_reflective_bsdf name="b" type="BSDF"/>
<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>"""

# A row has three texels: V and roughness_u, L and roughness_v, N and the scale of the tangent.
MAIN = """
uniform sampler2D rows;
uniform int closureType;
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 a = texelFetch(rows, ivec2(at.x * 3, at.y), 0);
    vec4 b = texelFetch(rows, ivec2(at.x * 3 + 1, at.y), 0);
    vec4 c = texelFetch(rows, ivec2(at.x * 3 + 2, at.y), 0);
    ClosureData data = makeClosureData(closureType, b.xyz, a.xyz, c.xyz, vec3(0.0), 1.0);
    BSDF bsdf = BSDF(vec3(0.0), vec3(1.0));
    mx_retro_reflective_bsdf(data, bsdf, 1.0, a.w, b.w, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), c.xyz, vec3(c.w, 0.0, 0.0), bsdf);
    out1 = vec4(bsdf.response.xy, bsdf.throughput.xy);
}
"""
VERTEX = "#version 400\nin vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }"
WIDTH = 256
REFLECTION, TRANSMISSION, INDIRECT = 1, 2, 3


class Gpu:
    def __init__(self, environment="NONE", path=None):
        self.context = moderngl.create_standalone_context(backend="egl")
        source = stages(generate(parse(DOCUMENT, data_library(path)), "glsl", environment, path=path))["pixel"]
        head = source[: source.index("void main()")]
        self.program = self.context.program(vertex_shader=VERTEX, fragment_shader=head + MAIN)
        self.name = self.context.info["GL_RENDERER"]

    def environment(self, radiance, irradiance, samples):
        """The levels of the lat-long maps (rows, columns, 3), those after the last being its mipmaps; samples of a look-up."""
        for unit, (name, levels) in enumerate([("u_envRadiance", radiance), ("u_envIrradiance", irradiance)], 1):
            if name in self.program:
                height, width, _ = levels[0].shape
                texture = self.context.texture((width, height), 3, dtype="f4")
                for level, image in enumerate(levels):
                    texture.write(image.astype(np.float32).tobytes(), level=level)
                    if level == 0:
                        texture.build_mipmaps()
                texture.filter = (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR)
                texture.use(unit)
                self.program[name] = unit
                if name == "u_envRadiance":
                    self.set("u_envRadianceMips", int(np.log2(max(width, height))) + 1)
        self.set("u_envRadianceSamples", samples)

    def set(self, name, value):
        if name in self.program:
            self.program[name] = value

    def bsdf(self, roughness, wo, wi, closure=REFLECTION, normal=(0, 0, 1), tangent=1.0):
        """Response of single scattering and of its compensation, throughput of each, by row."""
        context, count = self.context, len(wo)
        height = -(-count // WIDTH)
        rows = np.zeros((height * WIDTH, 3, 4), np.float32)
        rows[:count, 0, :3], rows[:count, 0, 3] = wo, roughness[:, 0]
        rows[:count, 1, :3], rows[:count, 1, 3] = wi, roughness[:, 1]
        rows[:count, 2, :3], rows[:count, 2, 3] = normal, tangent
        texture = context.texture((WIDTH * 3, height), 4, rows.tobytes(), dtype="f4")
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        texture.use(0)
        self.set("rows", 0)
        self.set("closureType", closure)
        target = context.texture((WIDTH, height), 4, dtype="f4")
        context.framebuffer([target]).use()
        triangle = context.buffer(np.array([-1, -1, 3, -1, -1, 3], np.float32).tobytes())
        context.vertex_array(self.program, [(triangle, "2f", "at")]).render()
        return np.frombuffer(target.read(), np.float32).reshape(-1, 4)[:count].astype(np.float64)
