"""Every document through every generator and, where there is one, the language's compiler."""

import pathlib
import tempfile
import unittest

import MaterialX.PyMaterialXGenShader as gen_shader

from support import (ENVIRONMENTS, GENERATORS, HARDWARE, MATERIALS, RESOURCES, data_library, documents, generate, installed,
                     missing, read, report, run, search_path, stages, tool, with_upstream_environment)


class Generate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.library = data_library()
        cls.folder = tempfile.TemporaryDirectory()
        cls.shaders = {}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def each(self, *targets, paths=None, path=None):
        """Every document as the targets' source files: (what it is, stage, path)."""
        library = data_library(path) if path else self.library
        for file in paths or documents():
            document = read(file, library)
            for target in targets:
                for environment in ENVIRONMENTS if target in HARDWARE else ["FIS"]:
                    for stage, source in stages(generate(document, target, environment, path=path)).items():
                        name = f"{file.stem}.{target}.{environment}"
                        suffix = {"vertex": "vert", "pixel": "frag"}[stage]
                        out = pathlib.Path(self.folder.name) / f"{name}.{suffix}"
                        out.write_text(source)
                        yield name, stage, out, source

    def accept(self, targets, check, **options):
        """How many stages of these targets a compiler accepts: `check` returns what it says, and whether it is content."""
        count = 0
        for name, stage, path, source in self.each(*targets, **options):
            output, good = check(stage, path, source)
            self.assertTrue(good, f"{name} {stage}: {output}")
            count += 1
        return count

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

    def test_a_host_without_library_prefix_gets_the_same_text(self):
        """MaterialX looks its files up as libraries/..., or without that word where a host has `libraries` itself on its path."""
        path = search_path(installed() / "libraries")
        for file in documents():
            document = read(file, self.library)
            for target in HARDWARE:
                for environment in ENVIRONMENTS:
                    with self.subTest(file.stem, target=target, environment=environment):
                        usual = stages(generate(document, target, environment))
                        self.assertEqual(stages(generate(document, target, environment, path=path, prefix="")), usual)

    def test_the_upstream_environment_compiles(self):
        """The functions of the environment modes, included by MaterialX's own files of the modes: one definition each."""
        one = {"paths": [MATERIALS / "retro_sheeting.mtlx"]}
        with tempfile.TemporaryDirectory() as folder:
            one["path"] = with_upstream_environment(folder)
            compiler = tool(self, "glslangValidator")
            count = self.accept(["glsl", "essl"], lambda _, path, __: run(compiler, path), **one)
            count += self.accept(["vk", "wgsl"], lambda _, path, __: run(compiler, "-V", path, "-o", f"{path}.spv"), **one)
            count += self.accept(["msl"], self.metal, **one)
            count += self.accept(["slang"], self.slang(), **one)
            report(f"upstream form: {count} stages are accepted")

    def test_the_exported_documents_compile(self):
        """The presets, and the document for MaterialX's TestSuite."""
        compiler, count = tool(self, "glslangValidator"), 0
        for file in RESOURCES.rglob("*.mtlx"):
            document = read(file, self.library)
            for element in gen_shader.findRenderableElements(document):
                for stage, source in stages(generate(document, "glsl", element=element)).items():
                    out = pathlib.Path(self.folder.name) / f"exported.{ {'vertex': 'vert', 'pixel': 'frag'}[stage]}"
                    out.write_text(source)
                    output, good = run(compiler, out)
                    self.assertTrue(good, f"{file.stem} {element.getNamePath()}: {output}")
                    count += 1
        report(f"glslangValidator accepts {count} stages of the exported documents")

    def test_glsl_compiles(self):
        compiler = tool(self, "glslangValidator")
        count = self.accept(["glsl", "essl"], lambda _, path, __: run(compiler, path))
        report(f"glslangValidator accepts {count} stages of glsl and essl")

    def test_vulkan_compiles_and_validates(self):
        compiler, validator = tool(self, "glslangValidator"), tool(self, "spirv-val")

        def check(_, path, __):
            module = path.with_suffix(".spv")
            output, good = run(compiler, "-V", path, "-o", module)
            return run(validator, module) if good else (output, good)

        report(f"spirv-val accepts {self.accept(['vk', 'wgsl'], check)} stages of vk and wgsl")

    @staticmethod
    def metal(_, __, source):
        import metal
        found = metal.errors(source)
        return found, found == ""

    def test_metal_has_the_right_types(self):
        import metal
        self.assertIn("no matching function", metal.errors("using namespace metal; float f(float3 x) { return dot(x, x.xy); }"))
        report(f"clang accepts {self.accept(['msl'], self.metal)} stages of msl")

    def test_naga_translates_to_wgsl(self):
        naga = tool(self, "naga")

        def check(stage, path, _):
            wgsl = path.with_suffix(".wgsl")
            return run(naga, path, wgsl, "--input-kind", "glsl", "--shader-stage", "frag") if stage == "pixel" else ("", True)

        report(f"naga translates {self.accept(['wgsl'], check) // 2} pixel stages to WGSL")

    def slang(self):
        import slang
        try:
            compiler = slang.Compiler()
        except Exception as error:  # noqa: BLE001 - no package, another system: the reason is what counts
            missing(self, f"no Slang: {error}")
        return lambda _, __, source: compiler.compile(source)

    def test_slang_compiles(self):
        report(f"Slang accepts {self.accept(['slang'], self.slang())} stages")


if __name__ == "__main__":
    unittest.main()
