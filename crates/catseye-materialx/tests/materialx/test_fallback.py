"""Where the library is missing: its nodes as nodes of MaterialX's own, which MaterialX makes of them."""

import pathlib
import tempfile
import unittest

from support import (GENERATORS, MATERIALS, data_library, documents, flatten, generate, parse, read, run, stages, stock, tool,
                     translate)

MODELS = ["open_pbr_surface", "standard_surface", "gltf_pbr", "UsdPreviewSurface"]
SHEETING = MATERIALS / "retro_sheeting.mtlx"
MAPPED = """<?xml version="1.0"?><materialx version="1.39"><nodegraph name="g">
<image name="color" type="color3"><input name="file" type="filename" value="color.png" colorspace="srgb_texture"/></image>
<image name="bumps" type="vector3"><input name="file" type="filename" value="normal.png"/></image>
<normalmap name="normal" type="vector3"><input name="in" type="vector3" nodename="bumps"/></normalmap>
<output name="color_out" type="color3" nodename="color"/><output name="normal_out" type="vector3" nodename="normal"/></nodegraph>
<retro_sheeting_surface name="s" type="surfaceshader">
<input name="base_color" type="color3" nodegraph="g" output="color_out"/>
<input name="normal" type="vector3" nodegraph="g" output="normal_out"/></retro_sheeting_surface>
<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>"""


class Fallback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.library = data_library()
        cls.stock = stock()

    def accepted(self, document, name):
        """Validates; every generator takes it, and glslangValidator takes the GLSL."""
        valid, message = document.validate()
        self.assertTrue(valid, f"{name}: {message}")
        compiler = tool(self, "glslangValidator")
        with tempfile.TemporaryDirectory() as folder:
            for target in GENERATORS:
                for stage, source in stages(generate(document, target)).items():
                    self.assertNotIn("mx_retro_reflective", source, f"{name} {target}")
                    if target in ("glsl", "vk"):
                        path = pathlib.Path(folder) / f"shader.{ {'vertex': 'vert', 'pixel': 'frag'}[stage]}"
                        path.write_text(source)
                        vulkan = ["-V", "-o", f"{path}.spv"] if target == "vk" else []
                        output, good = run(compiler, *vulkan, path)
                        self.assertTrue(good, f"{name} {target} {stage}: {output}")

    def test_the_surface_is_translated(self):
        for model in MODELS:
            for name, document in [("sheeting", read(SHEETING, self.library)), ("mapped", parse(MAPPED, self.library))]:
                with self.subTest(name, model=model):
                    translate(document, model)
                    self.accepted(document, f"{name} as {model}")
                    self.accepted(flatten(document, self.stock), f"{name} as {model}, flattened")

    def test_a_normal_map_and_a_texture_survive(self):
        for model, port in [("open_pbr_surface", "geometry_normal"), ("standard_surface", "normal"), ("gltf_pbr", "normal"),
                            ("UsdPreviewSurface", "normal")]:
            with self.subTest(model):
                document = parse(MAPPED, self.library)
                translate(document, model)
                flatten(document, self.stock)
                [shader] = document.getNodes(model)
                files = {edge.getUpstreamElement().getNamePath() for edge in shader.getConnectedOutput(port).traverseGraph()}
                self.assertIn("g/bumps", files)

    def test_every_document_is_flattened(self):
        """The BSDF as nodes of MaterialX's own, for hosts that take documents but no code."""
        for path in documents():
            with self.subTest(path.name):
                self.accepted(flatten(read(path, self.library), self.stock), path.name)

    def test_a_target_without_an_implementation_gets_the_stock_nodes(self):
        nodedef = self.library.getNodeDef("ND_retro_reflective_bsdf")
        self.assertEqual(nodedef.getImplementation("genosl").getFile(), "mx_retro_reflective_bsdf.osl")
        self.assertEqual(nodedef.getImplementation("genglsl").getName(), "NG_retro_reflective_bsdf_genglsl")
        self.library.addTargetDef("genother")
        self.assertEqual(nodedef.getImplementation("genother").getName(), "NG_retro_reflective_bsdf")


if __name__ == "__main__":
    unittest.main()
