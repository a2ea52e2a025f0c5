"""Generates a document's OSL: `python write_osl.py MATERIAL.mtlx SHADER.osl`, with MaterialX's header beside it."""

import pathlib
import shutil
import sys

from support import connect_constants, data_library, generate, read, search_path, stages


def main(material, shader):
    document = connect_constants(read(material, data_library()))
    shader = pathlib.Path(shader)
    shader.write_text(stages(generate(document, "osl"))["pixel"])
    header = search_path().find("libraries/stdlib/genosl/include/mx_funcs.h")
    shutil.copy(header.asString(), shader.parent)


if __name__ == "__main__":
    main(*sys.argv[1:])
