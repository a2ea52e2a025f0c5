"""What `catseye export` writes for engines is read by what nobody here wrote, and its stated errors are measured again:
MaterialX's own graphs of glTF and OpenPBR, and the GLSL of three.js."""

import csv
import io
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import MaterialX as mx
import numpy as np

from support import HERE, MATERIALS, installed, missing, report, run, stages, generate, stock, tool

THREE = "three@0.187.0"
# A standard with a table of its own and a colour, and a fitted material with two lobes and a bend.
STANDARD = "fmvss108:dot-c2:red"
MATERIAL = MATERIALS / "vest_iso20471.mtlx"
# `catseye measure` evaluates in single precision: 6e-4 by its own statement, and errors are differences of ratios.
BOUND = 1e-3
# The distribution of three.js loses digits in single precision: 1e-7 of the cosine beside alpha^2 = 2e-5.
THREE_BOUND = 0.02


def measured(path, rows, *options):
    """R_A at pairs of observation and entrance angle in degrees."""
    table = "observation_deg,entrance_deg\n" + "".join(f"{a},{b}\n" for a, b in rows)
    output, good = run(os.environ["CATSEYE"], "measure", path, "--geometry", "-", *options, input=table)
    assert good, output
    return np.array([float(row["model"]) for row in csv.DictReader(io.StringIO(output))])


class Exported:
    """A file, what was said of it, and the values that it stands for."""

    def __init__(self, case, target, subject, name):
        if "CATSEYE" not in os.environ:
            missing(case, "CATSEYE does not name the catseye command")
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name) / name
        options = ["--luminance-factor", "0.1"] if subject == STANDARD else []
        output, good = run(os.environ["CATSEYE"], "export", target, subject, *options, "-o", self.path, "--json")
        case.assertTrue(good, output)
        self.facts = json.loads(output)
        self.stated = {entry["against"]: entry for entry in self.facts["deviations"]}
        self.text = self.path.read_text()
        self.values = {part: rows for part, rows in self.grid(subject, options).items() if rows}
        if subject == STANDARD:
            output, good = run(os.environ["CATSEYE"], "standards", "show", subject)
            self.values["table"] = [(float(row["observation_deg"]), float(row["entrance_deg"]), float(row["value"]))
                                    for row in csv.DictReader(io.StringIO(output))]

    def grid(self, subject, options):
        """The original where it is at least a tenth of its greatest value at the same entrance angle, and a hundredth."""
        output, good = run(os.environ["CATSEYE"], "--quiet", "export", "csv", subject, *options, "-o", "-")
        assert good, output
        rows = [(float(row["observation_deg"]), float(row["entrance_deg"]), float(row["value"]))
                for row in csv.DictReader(io.StringIO(output))]
        greatest = {b: max(value for _, other, value in rows if other == b) for _, b, _ in rows}
        share = lambda row: row[2] / greatest[row[1]]
        return {"lobe": [row for row in rows if share(row) >= 0.1],
                "tail": [row for row in rows if 0.01 <= share(row) < 0.1]}

    def check(self, case, measure, bound=BOUND):
        """The stated errors are those that `measure` finds at the same angles."""
        case.assertEqual(set(self.stated), set(self.values))
        for against, rows in self.values.items():
            stated = self.stated[against]
            found = measure([(a, b) for a, b, _ in rows])
            error = found / np.array([value for _, _, value in rows]) - 1
            # The table's luminance factor is one more value, met exactly or nearly so.
            more = stated["values"] - len(rows)
            case.assertIn(more, [0, 1] if against == "table" else [0])
            worst = error[np.argmax(np.abs(error))]
            rms = np.sqrt(np.sum(error**2) / stated["values"])
            report(f"{self.path.name} against the {against}: worst {worst:+.3f}, rms {rms:.3f}, stated "
                   f"{stated['worst']:+.3f}, {stated['rms']:.3f}")
            case.assertLess(abs(worst - stated["worst"]), bound * (1 + abs(worst)))
            case.assertLess(abs(rms - stated["rms"]), bound * (1 + rms))


def retro_libraries(folder):
    """MaterialX's libraries, with the reflections of glTF's and OpenPBR's graphs turned back: what both say their
    retro-reflection is where its weight is 1. OpenPBR's dielectric has the index 1 here, and nothing to turn back."""
    root = pathlib.Path(folder)
    shutil.copytree(installed() / "libraries", root / "libraries")
    flag = '<input name="retroreflective" type="boolean" value="true" />'
    for file, nodes in {"gltf_pbr": ["reflection_bsdf", "metal_bsdf"],
                        "open_pbr_surface": ["metal_bsdf"]}.items():
        path = root / f"libraries/bxdf/{file}.mtlx"
        text = path.read_text()
        for node in nodes:
            text, count = re.subn(rf'(<\w+ name="{node}" type="BSDF">)', rf"\1{flag}", text)
            assert count == 1, (file, node, count)
        if file == "open_pbr_surface":
            weight = '<input name="specular_retroreflectivity" type="float" value="0.0" />'
            text, count = re.subn(r"(<nodedef [^>]*>)", rf"\1{weight}", text, count=1)
            assert count == 1
        path.write_text(text)
    return root


SUBJECTS = [STANDARD, MATERIAL]


class BackVector(unittest.TestCase):
    def test_materialx_takes_it_and_it_is_as_stated(self):
        for subject in SUBJECTS:
            exported = Exported(self, "materialx-back-vector", subject, "m.mtlx")
            document = mx.createDocument()
            mx.readFromXmlFile(document, str(exported.path))
            document.setDataLibrary(stock())
            self.assertEqual(document.validate(), (True, ""))
            self.assertIn("reflect(-V", stages(generate(document, "glsl"))["pixel"])
            exported.check(self, lambda rows: measured(exported.path, rows))
            self.assertIn("worst", exported.text.split("<materialx")[0])


class OpenPbr(unittest.TestCase):
    def test_its_graph_in_materialx_returns_what_is_stated(self):
        with tempfile.TemporaryDirectory() as folder:
            root = retro_libraries(folder)
            for subject in SUBJECTS:
                exported = Exported(self, "openpbr", subject, "m.mtlx")
                exported.check(self, lambda rows: measured(exported.path, rows, "--materialx-path", root))
                self.assertIn("worst", exported.text.split("<materialx")[0])

    def test_all_but_the_new_input_is_in_materialx(self):
        exported = Exported(self, "openpbr", STANDARD, "m.mtlx")
        document = mx.createDocument()
        mx.readFromXmlString(document, exported.text)
        document.setDataLibrary(stock())
        [surface] = document.getNodes("open_pbr_surface")
        self.assertEqual(surface.getInput("specular_retroreflectivity").getValue(), 1.0)
        surface.removeInput("specular_retroreflectivity")
        self.assertEqual(document.validate(), (True, ""))


class Gltf(unittest.TestCase):
    def test_its_graph_in_materialx_returns_what_is_stated(self):
        with tempfile.TemporaryDirectory() as folder:
            root = retro_libraries(folder)
            for subject in SUBJECTS:
                exported = Exported(self, "gltf", subject, "m.gltf")
                path = pathlib.Path(folder) / "gltf.mtlx"
                path.write_text(gltf_pbr(exported.text))
                exported.check(self, lambda rows: measured(path, rows, "--materialx-path", root))

    def test_the_asset_is_that_of_the_draft(self):
        """Names and ranges of KhronosGroup/glTF pull request 2610 at 6214bb21, and of KHR_materials_specular."""
        asset = json.loads(Exported(self, "gltf", STANDARD, "m.gltf").text)
        [material] = asset["materials"]
        self.assertEqual(asset["asset"]["version"], "2.0")
        self.assertEqual(set(asset["extensionsUsed"]), set(material["extensions"]))
        self.assertEqual(set(material["extensions"]), {"KHR_materials_retroreflection", "KHR_materials_specular"})
        retro = material["extensions"]["KHR_materials_retroreflection"]
        self.assertLessEqual(set(retro), {"retroreflectionFactor", "retroreflectionTexture"})
        specular = material["extensions"]["KHR_materials_specular"]
        self.assertLessEqual(set(specular), {"specularFactor", "specularColorFactor"})
        base = material["pbrMetallicRoughness"]
        shares = [retro["retroreflectionFactor"], specular["specularFactor"], base["roughnessFactor"],
                  base["metallicFactor"], *base["baseColorFactor"]]
        self.assertTrue(all(0 <= share <= 1 for share in shares), shares)
        self.assertTrue(min(specular["specularColorFactor"]) >= 0 and len(specular["specularColorFactor"]) == 3)
        self.assertIn("deviations", material["extras"]["catseye"])


    def test_the_validator_of_khronos_has_no_complaint(self):
        """It does not know the draft, and says so: an information, not an error or a warning."""
        node, packages = packages_of(self, "gltf-validator@2.0.0-dev.3.10")
        exported = Exported(self, "gltf", STANDARD, "m.gltf")
        with tempfile.TemporaryDirectory(dir=packages) as folder:
            script = pathlib.Path(folder) / "validate.mjs"
            script.write_text("""
                import { readFileSync } from 'node:fs';
                import validator from 'gltf-validator';
                const report = await validator.validateBytes(new Uint8Array(readFileSync(process.argv[2])));
                console.log(JSON.stringify(report.issues));""")
            output, good = run(node, script, exported.path)
        self.assertTrue(good, output)
        issues = json.loads(output)
        self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues)


def packages_of(case, package):
    """node, and the folder that a package of npm is in: beside the packages of Python, where it stays."""
    node, npm = tool(case, "node"), tool(case, "npm")
    name = package.split("@")[0]
    packages = pathlib.Path(sys.prefix) / f"npm-{name}"
    if not (packages / "node_modules" / name).exists():
        output, good = run(npm, "install", "--prefix", packages, "--ignore-scripts", package)
        if not good:
            missing(case, f"{package} can't be installed: {output}")
    return node, packages


def gltf_pbr(text):
    """The material of an asset as MaterialX's node of glTF's model."""
    [material] = json.loads(text)["materials"]
    base, specular = material["pbrMetallicRoughness"], material["extensions"]["KHR_materials_specular"]
    color = lambda values: ", ".join(repr(value) for value in values)
    inputs = [("base_color", "color3", color(base["baseColorFactor"][:3])), ("metallic", "float", base["metallicFactor"]),
              ("roughness", "float", base["roughnessFactor"]), ("specular", "float", specular["specularFactor"]),
              ("specular_color", "color3", color(specular["specularColorFactor"]))]
    lines = "".join(f'<input name="{name}" type="{kind}" value="{value}" />' for name, kind, value in inputs)
    return (f'<materialx version="1.39"><gltf_pbr name="s" type="surfaceshader">{lines}</gltf_pbr>'
            '<surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s" />'
            "</surfacematerial></materialx>")


class Three(unittest.TestCase):
    def test_three_reads_it_and_its_shader_returns_what_is_stated(self):
        node, packages = packages_of(self, THREE)
        try:
            from three import Shader
        except ImportError as error:
            missing(self, f"no OpenGL from Python: {error}")
        for subject in SUBJECTS:
            exported = Exported(self, "three", subject, "m.js")
            shader = Shader(node, packages, exported.text)
            exported.check(self, lambda rows: shader.r_a(rows), THREE_BOUND)
            self.assertIn("worst", exported.text.split("import")[0])


if __name__ == "__main__":
    unittest.main()
