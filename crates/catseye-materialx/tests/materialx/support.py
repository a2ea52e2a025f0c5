"""What the tests share: the library loaded beside MaterialX's own, the generators, the example documents."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import MaterialX as mx
import MaterialX.PyMaterialXGenGlsl as gen_glsl
import MaterialX.PyMaterialXGenMdl as gen_mdl
import MaterialX.PyMaterialXGenMsl as gen_msl
import MaterialX.PyMaterialXGenOsl as gen_osl
import MaterialX.PyMaterialXGenShader as gen_shader
import MaterialX.PyMaterialXGenSlang as gen_slang

HERE = pathlib.Path(__file__).resolve().parent
CRATE = HERE.parents[1]
ROOT = CRATE.parents[1]
LIBRARIES = CRATE / "libraries"
MATERIALS = ROOT / "materials"
RESOURCES = CRATE / "resources"
PRESETS = RESOURCES / "Materials/Examples/RetroSheeting/retro_sheeting_presets.mtlx"
EVIDENCE = pathlib.Path(os.environ.get("CATSEYE_EVIDENCE", ROOT / "target/evidence/materialx"))
REQUIRE_ALL = os.environ.get("CATSEYE_REQUIRE") == "all"

GENERATORS = {
    "glsl": gen_glsl.GlslShaderGenerator,
    "essl": gen_glsl.EsslShaderGenerator,
    "vk": gen_glsl.VkShaderGenerator,
    "wgsl": gen_glsl.WgslShaderGenerator,
    "msl": gen_msl.MslShaderGenerator,
    "slang": gen_slang.SlangShaderGenerator,
    "osl": gen_osl.OslShaderGenerator,
    "mdl": gen_mdl.MdlShaderGenerator,
}
HARDWARE = ["glsl", "essl", "vk", "wgsl", "msl", "slang"]
ENVIRONMENTS = ["NONE", "PREFILTER", "FIS"]


def search_path(*roots):
    """The roots that hold a folder `libraries`: the installed MaterialX, unless others are given, and this crate."""
    path = mx.FileSearchPath() if roots else mx.getDefaultDataSearchPath()
    for root in (*roots, CRATE):
        path.append(mx.FilePath(str(root)))
    return path


def data_library(path=None):
    """MaterialX's definitions and ours."""
    path = path or search_path()
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), path, library)
    mx.loadLibraries(["libraries/catseye"], path, library)
    return library


def stock():
    """MaterialX's definitions alone."""
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    return library


def translate(document, model):
    """Makes every surface shader one of this model, as MaterialX's `translateshader.py` does before it bakes."""
    gen_shader.ShaderTranslator.create().translateAllMaterials(document, model)
    return document


def flatten(document, library):
    """Replaces our nodes by the nodes of their graphs, down to those of the given library."""
    for graph in [document, *document.getNodeGraphs()]:
        graph.flattenSubgraphs("", lambda node: node.getCategory().startswith("retro_"))
    document.setDataLibrary(library)
    return document


def installed():
    """The folder that holds the installed MaterialX's `libraries`."""
    return pathlib.Path(mx.getDefaultDataSearchPath().asString().split(os.pathsep)[0])


def with_upstream_environment(folder):
    """A search path on a copy of MaterialX's libraries in which each environment mode has our lobe's function, as it would
    upstream: our file of the mode beside MaterialX's, and a line at its end that includes it."""
    root = pathlib.Path(folder)
    shutil.copytree(installed() / "libraries", root / "libraries")
    lib = root / "libraries/pbrlib/genglsl/lib"
    for path in (LIBRARIES / "catseye/genglsl/lib").glob("mx_retro_reflective_*.glsl"):
        shutil.copy(path, lib)
    for mode in ("fis", "prefilter", "none"):
        with (lib / f"mx_environment_{mode}.glsl").open("a") as file:
            file.write(f'\n#include "mx_retro_reflective_environment_{mode}.glsl"\n')
    return search_path(root)


def documents():
    """The workspace's materials."""
    return sorted(MATERIALS.glob("*.mtlx"))


def read(path, library):
    document = mx.createDocument()
    mx.readFromXmlFile(document, str(path))
    document.setDataLibrary(library)
    return document


def parse(text, library):
    document = mx.createDocument()
    mx.readFromXmlString(document, text)
    document.setDataLibrary(library)
    return document


def material(document):
    [element] = [node for node in document.getNodes() if node.getType() == "material"]
    return element


def generate(document, target, environment="FIS", lights=None, path=None, prefix="libraries", element=None):
    """The generated shader of the document's only material, or of an element. MaterialX looks its own files up as `prefix`/..., on the search path."""
    generator = GENERATORS[target].create()
    colors = gen_shader.DefaultColorManagementSystem.create(generator.getTarget())
    colors.loadLibrary(document.getDataLibrary())
    generator.setColorManagementSystem(colors)
    context = gen_shader.GenContext(generator)
    context.registerSourceCodeSearchPath(path or search_path())
    options = context.getOptions()
    options.libraryPrefix = mx.FilePath(prefix)
    options.hwSpecularEnvironmentMethod = getattr(
        gen_shader.HwSpecularEnvironmentMethod, f"SPECULAR_ENVIRONMENT_{environment}")
    options.hwMaxActiveLightSources = 4
    options.targetColorSpaceOverride = "lin_rec709"
    if lights is not None:
        lights(context, generator)
    return generator.generate("material", element or material(document), context)


def connect_constants(document):
    """MaterialX 1.39.5's generators ignore a literal where the port has a default geometric property: tangents must come
    from a node."""
    for graph in [document, *document.getNodeGraphs()]:
        for node in graph.getNodes("retro_reflective_bsdf"):
            port = node.getInput("tangent_u")
            if port is not None and port.hasValueString():
                constant = graph.addNode("constant", f"{node.getName()}_tangent", "vector3")
                constant.addInput("value", "vector3").setValueString(port.getValueString())
                port.removeAttribute("value")
                port.setConnectedNode(constant)
    return document


def stages(shader):
    """The source of each stage, by name."""
    return {name: complete(shader.getSourceCode(name)) for name in ("vertex", "pixel") if shader.hasStage(name)}


def complete(source):
    """Without an environment MaterialX 1.39.5 does not declare u_refractionTwoSided, which its own refraction uses."""
    name = "u_refractionTwoSided"
    if name not in source or re.search(rf"\w+ {name}( =|;)", source):
        return source
    # GLSL's version must stay the first line; Slang has none, and wants its constants static.
    version, rest = re.fullmatch(r"(#version[^\n]*\n|)(.*)", source, re.DOTALL).groups()
    return f"{version}{'' if version else 'static '}const bool {name} = false;\n{rest}"


def tool(case, name):
    """The path of a command; a test that lacks it is skipped, or fails where everything is required."""
    path = shutil.which(name)
    if path is None:
        missing(case, f"{name} is not installed")
    return path


def missing(case, reason):
    if REQUIRE_ALL:
        case.fail(reason)
    case.skipTest(reason)


def run(*command, **options):
    """Runs a command; returns its output and whether it succeeded."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    return done.stdout + done.stderr, done.returncode == 0


def report(*words):
    """Numbers for the test's log."""
    print(*words, file=sys.stderr)
