"""The exported library in programs that nobody of the project wrote: USD, a reader of MDL, MaterialX in WebAssembly."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import HERE, LIBRARIES, MATERIALS, PRESETS, missing, run, tool

# MaterialX 1.39.4 in WebAssembly.
WEB_PACKAGE = "@needle-tools/materialx@1.4.6"

# In a process of its own: the package brings its own MaterialX.
USD = """
import json, sys
import usdex.core
from pxr import Sdr, Usd, UsdShade
registry = Sdr.Registry()
def inputs(name):
    node = registry.GetShaderNodeByIdentifier(name)
    return list(node.GetShaderInputNames()) if node else None
stage = Usd.Stage.Open(sys.argv[1])
shaders = [UsdShade.Shader(prim) for prim in stage.Traverse()]
print(json.dumps({
    "nodes": {name: inputs(name) for name in ("ND_retro_reflective_bsdf", "ND_retro_sheeting_surface")},
    "used": [registry.GetShaderNodeByIdentifier(shader.GetShaderId()) is not None for shader in shaders if shader],
}))
"""


class Usd(unittest.TestCase):
    def answer(self, folder):
        """What USD knows of the nodes and of the presets' shaders, and what it warns of."""
        environment = {**os.environ, "PXR_MTLX_PLUGIN_SEARCH_PATHS": str(folder)}
        done = subprocess.run([sys.executable, "-B", "-c", USD, PRESETS], capture_output=True, text=True, check=False,
                              env=environment)
        if "No module named 'usdex'" in done.stderr:
            missing(self, "the package usd-exchange is not installed")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1]), done.stderr

    def test_usd_finds_the_nodes(self):
        found, warnings = self.answer(LIBRARIES)
        self.assertIn("roughness_v", found["nodes"]["ND_retro_reflective_bsdf"])
        self.assertIn("half_power_angle", found["nodes"]["ND_retro_sheeting_surface"])
        self.assertGreater(len(found["used"]), 10)
        self.assertTrue(all(found["used"]))
        self.assertNotIn("unrecognized type", warnings)

    def test_without_the_path_it_does_not(self):
        with tempfile.TemporaryDirectory() as empty:
            found, _ = self.answer(empty)
        self.assertEqual(set(found["nodes"].values()), {None})


class Mdl(unittest.TestCase):
    def test_the_module_is_read_and_bound(self):
        try:
            import shadewire
        except ImportError:
            missing(self, "the package shadewire is not installed")
        path = LIBRARIES / "catseye/genmdl/catseye/catseye.mdl"
        text = path.read_text()
        self.assertEqual(shadewire.mdl.material_names(text), ["mx_retro_reflective_bsdf"])
        ir = shadewire.mdl.to_ir(text, models=["surface"], location=str(path))
        self.assertIn("roughness", ir.dump())
        with self.assertRaises(shadewire.ShadewireError):
            shadewire.mdl.to_ir(text.replace("backscattering_glossy", "no_such"), models=["surface"], location=str(path))


class Web(unittest.TestCase):
    def test_the_module_brings_the_nodes(self):
        node, npm, compiler = tool(self, "node"), tool(self, "npm"), tool(self, "glslangValidator")
        if "CATSEYE" not in os.environ:
            missing(self, "CATSEYE does not name the catseye command")
        # Beside the packages of Python, where it stays for the next run.
        packages = pathlib.Path(sys.prefix) / "npm"
        binaries = packages / "node_modules/@needle-tools/materialx/bin"
        if not binaries.exists():
            output, good = run(npm, "install", "--prefix", packages, "--ignore-scripts", "--legacy-peer-deps", WEB_PACKAGE)
            if not good:
                missing(self, f"{WEB_PACKAGE} can't be installed: {output}")
        with tempfile.TemporaryDirectory() as folder:
            output, good = run(os.environ["CATSEYE"], "materialx", "export", folder)
            self.assertTrue(good, output)
            module = pathlib.Path(folder) / "libraries/catseye/web/catseye.mjs"
            document = MATERIALS / "retro_sheeting.mtlx"
            command = [node, "--no-warnings", HERE / "web.mjs", binaries, module, document]
            shader, good = run(*command)
            self.assertTrue(good, shader)
            self.assertIn("mx_retro_reflective_bsdf(", shader)
            source = pathlib.Path(folder) / "shader.frag"
            source.write_text(shader)
            output, good = run(compiler, source)
            self.assertTrue(good, output)
            self.assertFalse(run(*command, "without")[1], "the nodes come from the module")


if __name__ == "__main__":
    unittest.main()
