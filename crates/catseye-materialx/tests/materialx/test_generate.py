"""Every document through every generator and, where there is one, the language's compiler."""

import pathlib
import tempfile
import unittest

from support import (ENVIRONMENTS, GENERATORS, HARDWARE, data_library, documents, generate, missing, read, report, run,
                     stages, tool)


class Generate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.library = data_library()
        cls.folder = tempfile.TemporaryDirectory()
        cls.shaders = {}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def each(self, *targets):
        """Every document as the targets' source files: (what it is, stage, path)."""
        for path in documents():
            document = read(path, self.library)
            for target in targets:
                for environment in ENVIRONMENTS if target in HARDWARE else ["FIS"]:
                    for stage, source in stages(generate(document, target, environment)).items():
                        name = f"{path.stem}.{target}.{environment}"
                        suffix = {"vertex": "vert", "pixel": "frag"}[stage]
                        out = pathlib.Path(self.folder.name) / f"{name}.{suffix}"
                        out.write_text(source)
                        yield name, stage, out, source

    def test_generates_the_same_text_twice(self):
        for target in GENERATORS:
            first = [(name, stage, source) for name, stage, _, source in self.each(target)]
            second = [(name, stage, source) for name, stage, _, source in self.each(target)]
            self.assertEqual(first, second)
            report(f"generated {target}: {len(first)} stages")

    def test_the_node_is_called(self):
        for target in GENERATORS:
            for name, stage, _, source in self.each(target):
                if stage == "pixel" and not name.startswith("matte_white"):
                    with self.subTest(name):
                        self.assertIn("mx_retro_reflective_bsdf(", source)

    def test_glsl_compiles(self):
        compiler = tool(self, "glslangValidator")
        count = 0
        for name, stage, path, _ in self.each("glsl", "essl"):
            output, good = run(compiler, path)
            self.assertTrue(good, f"{name} {stage}: {output}")
            count += 1
        report(f"glslangValidator accepts {count} stages of glsl and essl")

    def test_vulkan_compiles_and_validates(self):
        compiler, validator = tool(self, "glslangValidator"), tool(self, "spirv-val")
        count = 0
        for name, stage, path, _ in self.each("vk", "wgsl"):
            module = path.with_suffix(".spv")
            output, good = run(compiler, "-V", path, "-o", module)
            self.assertTrue(good, f"{name} {stage}: {output}")
            output, good = run(validator, module)
            self.assertTrue(good, f"{name} {stage}: {output}")
            count += 1
        report(f"spirv-val accepts {count} stages of vk and wgsl")

    def test_metal_has_the_right_types(self):
        import metal
        self.assertIn("no matching function", metal.errors("using namespace metal; float f(float3 x) { return dot(x, x.xy); }"))
        count = 0
        for name, stage, _, source in self.each("msl"):
            self.assertEqual(metal.errors(source), "", f"{name} {stage}")
            count += 1
        report(f"clang accepts {count} stages of msl")

    def test_naga_translates_to_wgsl(self):
        naga = tool(self, "naga")
        count = 0
        for name, stage, path, _ in self.each("wgsl"):
            if stage == "pixel":
                out = path.with_suffix(".wgsl")
                output, good = run(naga, path, out, "--input-kind", "glsl", "--shader-stage", "frag")
                self.assertTrue(good, f"{name}: {output}")
                count += 1
        report(f"naga translates {count} pixel stages to WGSL")

    def test_slang_compiles(self):
        import slang
        try:
            compiler = slang.Compiler()
        except Exception as error:  # noqa: BLE001 - no package, another system: the reason is what counts
            missing(self, f"no Slang: {error}")
        count = 0
        for name, stage, _, source in self.each("slang"):
            output, good = compiler.compile(source)
            self.assertTrue(good, f"{name} {stage}: {output}")
            count += 1
        report(f"Slang accepts {count} stages")


if __name__ == "__main__":
    unittest.main()
