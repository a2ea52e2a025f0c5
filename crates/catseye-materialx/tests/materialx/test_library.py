"""The library loads beside MaterialX's own, validates, and has for every target what the documentation says."""

import csv
import io
import os
import re
import unittest

import MaterialX as mx

from support import LIBRARIES, PRESETS, RESOURCES, ROOT, data_library, documents, missing, read, run, stock

TARGETS = ["genglsl", "essl", "genmsl", "genslang", "genosl", "genmdl"]


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.library = data_library()
        theirs = stock()
        cls.ours = [d for d in cls.library.getNodeDefs() if theirs.getNodeDef(d.getName()) is None]
        # Those for authors: one with a target is internal to the implementation for it, translations are MaterialX's affair.
        cls.public = [d for d in cls.ours if not d.getTarget() and d.getNodeGroup() != "translation"]

    def test_validates(self):
        valid, message = self.library.validate()
        self.assertTrue(valid, message)

    def test_documents_validate(self):
        for path in [*documents(), *RESOURCES.rglob("*.mtlx")]:
            with self.subTest(path.name):
                valid, message = read(path, self.library).validate()
                self.assertTrue(valid, message)

    def test_the_presets_meet_their_classes(self):
        """At least the coefficient of retro-reflection that the class in the preset's doc asks for, at each of its angles."""
        if "CATSEYE" not in os.environ:
            missing(self, "CATSEYE does not name the catseye command")
        presets = [node for node in read(PRESETS, self.library).getNodes() if node.getType() == "material"]
        self.assertGreater(len(presets), 10)
        for preset in presets:
            name, standard = preset.getName(), re.search(r"Class ([\w:-]+)\.$", preset.getDocString()).group(1)
            with self.subTest(name):
                output, good = run(os.environ["CATSEYE"], "measure", PRESETS, "--material", name, "--standard", standard)
                self.assertTrue(good, output)
                rows = list(csv.DictReader(io.StringIO(output)))
                self.assertTrue(rows)
                for row in rows:
                    self.assertGreaterEqual(float(row["model"]), float(row["value"]), row)

    def test_every_nodedef_is_implemented_as_documented(self):
        """The table of docs/materialx.md: a row for each nodedef, a column for each target."""
        text = (ROOT / "docs/materialx.md").read_text()
        rows = re.findall(r"^\| `(ND_\w+)` \|(.*)\|$", text, re.MULTILINE)
        documented = {name: [cell.strip() for cell in cells.split("|")] for name, cells in rows}
        self.assertEqual(sorted(documented), sorted(d.getName() for d in self.public))
        for nodedef in self.public:
            for target, cell in zip(TARGETS, documented[nodedef.getName()], strict=True):
                with self.subTest(nodedef=nodedef.getName(), target=target):
                    found = nodedef.getImplementation(target)
                    self.assertIsNotNone(found, "no implementation")
                    self.assertEqual(cell, self.kind(found))

    @staticmethod
    def kind(implementation):
        if implementation.isA(mx.NodeGraph):
            return "nodegraph"
        return f"`{implementation.getFile()}`"

    def test_every_port_is_described(self):
        for nodedef in self.public:
            self.assertTrue(nodedef.getDocString())
            for port in nodedef.getInputs():
                with self.subTest(nodedef=nodedef.getName(), port=port.getName()):
                    wanted = ["doc", "uiname", "uifolder"]
                    if port.getType() in ("float", "color3"):
                        wanted.append("uimin")
                        wanted.append("uimax" if port.hasAttribute("uimax") else "uisoftmax")
                    for name in wanted:
                        self.assertTrue(port.getAttribute(name), name)

    def test_every_file_is_used(self):
        folder = LIBRARIES / "catseye"
        used = set()
        for implementation in self.library.getImplementations():
            if implementation.getFile() and implementation.getNodeDef() in self.ours:
                used.add(implementation.getFile().split("/")[-1])
        sources = [p for p in folder.rglob("*") if p.suffix in (".glsl", ".osl", ".mdl") and p.parent.name != "lib"]
        self.assertEqual({p.name for p in sources}, used)


if __name__ == "__main__":
    unittest.main()
