"""The same sphere, light and camera through MaterialX's own renderer and through ours, in direct light.

Both pictures, their difference and the RMSE go to the evidence. The scene is that of
crates/catseye-render/examples/direct_sphere.rs, whose path the environment variable DIRECT_SPHERE gives.
"""

import math
import os
import pathlib
import tempfile
import unittest

import numpy as np

from support import EVIDENCE, MATERIALS, connect_constants, data_library, generate, missing, read, report, run

PIXELS = 256
# Samples of a pixel along each side in MaterialX's picture.
SUPERSAMPLING = 4
# Root mean square of the difference over the sphere, over the root mean square of our picture.
RELATIVE_RMSE = {
    "retro_roughness_005": 1e-4,
    "retro_roughness_015": 2e-4,
    "retro_roughness_050": 1e-3,
    "anisotropic_tape": 5e-4,
    "sheeting": 3e-3,
}
ANGLE = math.radians(3)


def write_sphere(path, columns=768, rows=384):
    """A sphere as a Wavefront file, with its exact normals."""
    lines = []
    for row in range(rows + 1):
        for column in range(columns + 1):
            theta, phi = math.pi * row / rows, 2 * math.pi * column / columns
            x, y, z = math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi)
            lines.append(f"v {x:.9f} {y:.9f} {z:.9f}\nvn {x:.9f} {y:.9f} {z:.9f}\n"
                         f"vt {column / columns:.6f} {1 - row / rows:.6f}")
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column + 1
            b, c, d = a + columns + 1, a + columns + 2, a + 1
            lines.append(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\nf {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}")
    path.write_text("\n".join(lines))


def load_exr(path):
    import OpenEXR
    with OpenEXR.File(str(path)) as file:
        return np.asarray(file.channels()["RGB"].pixels, np.float64)


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reason = None
        if "DIRECT_SPHERE" not in os.environ:
            cls.reason = "DIRECT_SPHERE does not name the example direct_sphere"
        elif "DISPLAY" not in os.environ:
            cls.reason = "no display: run under xvfb-run"
        EVIDENCE.mkdir(parents=True, exist_ok=True)
        cls.library = data_library()

    def setUp(self):
        if self.reason:
            missing(self, self.reason)

    def materialx(self, path):
        import MaterialX as mx
        import MaterialX.PyMaterialXRender as mx_render
        import MaterialX.PyMaterialXRenderGlsl as mx_glsl

        size = PIXELS * SUPERSAMPLING
        document = connect_constants(read(path, self.library))
        light = document.addNode("directional_light", "light", "lightshader")
        light.setInputValue("direction", mx.Vector3(-math.sin(ANGLE), 0.0, -math.cos(ANGLE)))
        light.setInputValue("color", mx.Color3(1.0, 1.0, 1.0))
        light.setInputValue("intensity", 3.0)

        renderer = mx_glsl.GlslRenderer.create(size, size, mx_render.BaseType.FLOAT)
        renderer.initialize()
        renderer.setImageHandler(mx_glsl.GLTextureHandler.create(mx_render.StbImageLoader.create()))
        lights = mx_render.LightHandler.create()
        renderer.setLightHandler(lights)
        geometry = mx_render.GeometryHandler.create()
        geometry.addLoader(mx_render.TinyObjLoader.create())
        with tempfile.TemporaryDirectory() as folder:
            sphere = pathlib.Path(folder) / "sphere.obj"
            write_sphere(sphere)
            self.assertTrue(geometry.loadGeometry(mx.FilePath(str(sphere)), False))
        renderer.setGeometryHandler(geometry)

        camera = mx_render.Camera.create()
        camera.setViewMatrix(mx_render.Camera.createViewMatrix(
            mx.Vector3(0, 0, 5), mx.Vector3(0, 0, 0), mx.Vector3(0, 1, 0)))
        half = math.tan(math.radians(13))
        camera.setProjectionMatrix(mx_render.Camera.createPerspectiveMatrix(-half, half, -half, half, 1.0, 100.0))
        renderer.setCamera(camera)

        def register(context, generator):
            lights.setLightSources([light])
            lights.registerLights(document, [light], context)

        renderer.createProgram(generate(document, "glsl", "FIS", register))
        lights.setDirectLighting(True)
        lights.setIndirectLighting(False)
        renderer.validateInputs()
        renderer.setSize(size, size)
        renderer.render()
        image = renderer.captureImage(None)
        flat = [image.getTexelColor(x, y) for y in range(size) for x in range(size)]
        rgb = np.array([[c[0], c[1], c[2]] for c in flat]).reshape(size, size, 3)
        return rgb.reshape(PIXELS, SUPERSAMPLING, PIXELS, SUPERSAMPLING, 3).mean(axis=(1, 3))

    def ours(self, path):
        out = EVIDENCE / f"{path.stem}.ours.exr"
        output, good = run(os.environ["DIRECT_SPHERE"], path, PIXELS, out)
        self.assertTrue(good, output)
        return load_exr(out)

    def test_direct_light(self):
        from PIL import Image
        for name, bound in RELATIVE_RMSE.items():
            path = MATERIALS / f"{name}.mtlx"
            theirs, ours = self.materialx(path), self.ours(path)
            # The sphere's edge is left out: its coverage is a matter of the renderer, not of the lobe.
            y, x = (np.mgrid[:PIXELS, :PIXELS] + 0.5) / PIXELS * 2 - 1
            radius = math.sqrt(1 / 24) / math.tan(math.radians(13))
            inside = np.hypot(x, y) < radius - 3 * 2 / PIXELS
            difference = theirs - ours
            rmse = math.sqrt(np.mean(difference[inside] ** 2))
            relative = rmse / math.sqrt(np.mean(ours[inside] ** 2))
            worst = np.abs(difference[inside]).max() / ours[inside].max()
            report(f"{name}: RMSE {rmse:.2e}, {relative:.2e} of the picture; greatest difference {worst:.1e} of the peak")
            peak = np.percentile(ours[inside], 99.5)
            panels = [theirs / peak, ours / peak, 0.5 + 10 * difference / peak]
            encoded = np.clip(np.concatenate(panels, axis=1), 0, 1) ** (1 / 2.2)
            Image.fromarray((encoded * 255 + 0.5).astype(np.uint8)).save(EVIDENCE / f"{name}.png")
            self.assertLess(relative, bound, name)


if __name__ == "__main__":
    unittest.main()
