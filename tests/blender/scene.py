"""Makes a scene as people make them in Blender, exports it and renders it with Cycles.

blender -b --factory-startup --python scene.py -- FOLDER writes scene.glb and cycles.exr there.
"""
import math
import os
import sys

import bpy

folder = sys.argv[sys.argv.index("--") + 1]
scene = bpy.context.scene


def image(name, size, color_of, data=False):
    made = bpy.data.images.new(name, size, size)
    if data:
        made.colorspace_settings.name = "Non-Color"
    pixels = []
    for y in range(size):
        for x in range(size):
            pixels.extend((*color_of((x + 0.5) / size, (y + 0.5) / size), 1))
    made.pixels = pixels
    made.pack()
    return made


def tiles(u, v):
    odd = (int(u * 8) + int(v * 8)) % 2
    return (0.75, 0.7, 0.6) if odd else (0.35, 0.25 + 0.3 * u, 0.55)


def bumps(u, v):
    """The normals of rounded bumps, 16 by 16."""
    slope_u = 0.4 * math.sin(2 * math.pi * 16 * u)
    slope_v = 0.4 * math.sin(2 * math.pi * 16 * v)
    length = math.sqrt(slope_u**2 + slope_v**2 + 1)
    return tuple(0.5 + 0.5 * c / length for c in (slope_u, slope_v, 1))


def worn(u, v):
    """Roughness in green and metallic in blue, as glTF has them."""
    return (0, 0.45 + 0.4 * u, 1 if int(v * 16) % 2 else 0)


def glow(u, v):
    return (1, 0.85, 0.6) if (int(u * 16) + int(v * 16)) % 2 else (0.9, 0.6, 0.4)


def principled(name, color=(0.8, 0.8, 0.8), **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ").title()].default_value = value
    return material, shader


def image_node(material, picture):
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = picture
    return node


def textured(name, picture, **inputs):
    material, shader = principled(name, **inputs)
    color = image_node(material, picture).outputs["Color"]
    material.node_tree.links.new(color, shader.inputs["Base Color"])
    return material, shader


def dress(thing, material):
    thing.data.materials.append(material)
    return thing


def add(operator, material, smooth=False, **keys):
    operator(**keys)
    if smooth:
        bpy.ops.object.shade_smooth()
    return dress(bpy.context.object, material)


def add_light(name, kind, energy, position, rotation=(0, 0, 0), **keys):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    for key, value in keys.items():
        setattr(data, key, value)
    thing = bpy.data.objects.new(name, data)
    thing.location = position
    thing.rotation_euler = [math.radians(angle) for angle in rotation]
    scene.collection.objects.link(thing)


def make_objects():
    mesh = bpy.ops.mesh
    floor, shader = textured("Floor", image("tiles", 128, tiles), roughness=0.6)
    bump = floor.node_tree.nodes.new("ShaderNodeNormalMap")
    links = floor.node_tree.links
    links.new(image_node(floor, image("bumps", 256, bumps, data=True)).outputs["Color"],
              bump.inputs["Color"])
    bump.inputs["Strength"].default_value = 0.8
    links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    add(mesh.primitive_plane_add, floor, size=12)

    red, _ = principled("Red plastic", (0.7, 0.08, 0.06), roughness=0.3)
    add(mesh.primitive_uv_sphere_add, red, smooth=True, segments=64, ring_count=32, radius=0.8,
        location=(-1.9, -0.2, 0.8))
    gold, _ = principled("Gold", (1, 0.71, 0.29), metallic=1, roughness=0.4)
    add(mesh.primitive_uv_sphere_add, gold, smooth=True, segments=64, ring_count=32, radius=0.8,
        location=(0.1, 0.6, 0.8))

    crate, shader = principled("Crate", (0.5, 0.55, 0.5))
    split = crate.node_tree.nodes.new("ShaderNodeSeparateColor")
    links = crate.node_tree.links
    links.new(image_node(crate, image("worn", 64, worn, data=True)).outputs["Color"],
              split.inputs["Color"])
    links.new(split.outputs["Green"], shader.inputs["Roughness"])
    links.new(split.outputs["Blue"], shader.inputs["Metallic"])
    add(mesh.primitive_cube_add, crate, size=1.4, location=(2, 0.3, 0.7), rotation=(0, 0, -0.3))

    lamp, shader = principled("Lamp", (0.1, 0.1, 0.1), emission_strength=5)
    lamp.node_tree.links.new(image_node(lamp, image("glow", 64, glow)).outputs["Color"],
                             shader.inputs["Emission"])
    add(mesh.primitive_cube_add, lamp, size=0.5, location=(1, -1.5, 0.25), rotation=(0, 0, 0.3))


def make_lights():
    # What glTF loses is 0 here: the sizes of lights, which soften shadows, and the world. Its spots
    # fade between angles, Blender's between cosines, which is a thin ring of the cone's rim.
    add_light("Sun", "SUN", 1.5, (0, 0, 6), (33, 5, 0), angle=0)
    add_light("Bulb", "POINT", 450, (-1.5, -3, 6.5), color=(0.7, 0.8, 1), shadow_soft_size=0)
    add_light("Spot", "SPOT", 700, (2.5, -5, 4), (55, 0, 7), color=(1, 0.9, 0.7),
              shadow_soft_size=0, spot_size=math.radians(60), spot_blend=0.15)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0


def make_camera():
    data = bpy.data.cameras.new("Camera")
    data.lens = 40
    data.dof.use_dof = True
    data.dof.focus_distance = 7.5
    data.dof.aperture_fstop = 0.4  # a radius of 40 mm / (2 * 0.4)
    camera = bpy.data.objects.new("Camera", data)
    camera.location = (0, -4.2, 6.7)
    camera.rotation_euler = (math.radians(32.5), 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera


def render(file):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = 320
    scene.render.resolution_y = 180
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = file
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = int(os.environ.get("SAMPLES", "1024"))
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    # What makes pictures wrong for the sake of less noise is off.
    cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 12
    bpy.ops.render.render(write_still=True)


for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
make_objects()
make_lights()
make_camera()
# The exporter's defaults, but that lights and cameras have to be asked for.
bpy.ops.export_scene.gltf(filepath=os.path.join(folder, "scene.glb"), export_cameras=True,
                          export_lights=True)
render(os.path.join(folder, "cycles.exr"))
