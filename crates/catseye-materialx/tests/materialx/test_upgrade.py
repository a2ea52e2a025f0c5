"""What MaterialX makes of documents of version 1.38 is what the reader's own upgrade is compared with."""

import pathlib
import sys
import tempfile
import unittest

import MaterialX as mx

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "upgrade"


def upgraded(old, new):
    document = mx.createDocument()
    mx.readFromXmlFile(document, str(old))
    mx.writeToXmlFile(document, str(new))


class Upgrade(unittest.TestCase):
    def test_the_upgraded_documents_are_materialx_own(self):
        """`python test_upgrade.py write` makes them again."""
        for old in sorted(FOLDER.glob("*.1.38.mtlx")):
            kept = old.with_name(old.name.replace("1.38", "1.39"))
            with tempfile.TemporaryDirectory() as folder:
                made = pathlib.Path(folder) / kept.name
                upgraded(old, made)
                self.assertEqual(kept.read_text(), made.read_text(), old.name)


if __name__ == "__main__":
    if sys.argv[1:] == ["write"]:
        for path in FOLDER.glob("*.1.38.mtlx"):
            upgraded(path, path.with_name(path.name.replace("1.38", "1.39")))
    else:
        unittest.main()
