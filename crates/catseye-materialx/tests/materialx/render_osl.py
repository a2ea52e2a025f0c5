"""Renders the sphere of crates/catseye-render/examples/direct_sphere.rs in Blender's Cycles with a generated OSL shader.

    python render_osl.py SHADER.osl PIXELS SAMPLES OUTPUT.exr

Needs the PyPI package bpy (5.0.1: Python 3.11, 1 GB), and the site-packages within it on PYTHONPATH. The numbers of
docs/materialx.md, the other commands with the tests' Python:

    python write_osl.py MATERIAL.mtlx sphere.osl
    python render_osl.py sphere.osl 256 64 theirs.exr
    cargo run --release -p catseye-render --example direct_sphere -- MATERIAL.mtlx 256 ours.exr
    python compare_sphere.py theirs.exr ours.exr
"""

import math
import pathlib
import sys

import bpy
import _cycles


def main(shader, pixels, samples, output):
    shader = pathlib.Path(shader)
    compiled = shader.with_suffix(".oso")
    if not _cycles.osl_compile(str(shader), str(compiled)):
        sys.exit(f"{shader} does not compile")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.shading_system = True
    scene.cycles.samples = samples
    scene.cycles.max_bounces = 0
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.sample_clamp_direct = 0.0
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 2
    scene.render.resolution_x = scene.render.resolution_y = pixels
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.film_transparent = False
    scene.render.filepath = str(pathlib.Path(output).resolve())

    camera = bpy.data.cameras.new("camera")
    camera.angle = math.radians(26)
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.camera.location = (0, 0, 5)
    scene.collection.objects.link(scene.camera)

    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = 3.0, 1e-4
    sun_object = bpy.data.objects.new("sun", sun)
    sun_object.rotation_euler = (0, math.radians(3), 0)
    scene.collection.objects.link(sun_object)

    bpy.ops.mesh.primitive_uv_sphere_add(segments=512, ring_count=256, radius=1)
    sphere = bpy.context.object
    bpy.ops.object.shade_smooth()
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    script = tree.nodes.new("ShaderNodeScript")
    script.mode = "EXTERNAL"
    script.filepath = str(compiled.resolve())
    surface = tree.nodes.new("ShaderNodeOutputMaterial")
    script.update()
    closures = [socket for socket in script.outputs if socket.type == "SHADER"]
    if not closures:
        sys.exit(f"{compiled} has no closure output: {[(s.name, s.type) for s in script.outputs]}")
    tree.links.new(closures[0], surface.inputs["Surface"])
    sphere.data.materials.append(material)
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
