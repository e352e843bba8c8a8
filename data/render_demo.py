# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the light_field_depth developers
"""Render the demo light field of light_field_depth with Blender (Cycles).

    blender -b -P data/render_demo.py -- OUTPUT_DIR [options]

writes into OUTPUT_DIR

    view_RR_CC.png     the views, 8-bit sRGB, row RR and column CC of the grid
    truth.pfm          the exact disparity of the centre view
    light_field.yaml   the description that the package reads

Options (after the ``--``):

    --size N        width and height of a view in pixels      (default 512)
    --samples N     samples per pixel, at most                (default 72)
    --views WHICH   cross   centre row and centre column      (default)
                    grid    the whole grid
                    centre  the centre view alone
                    none    no view (only truth and description)
                    R,C ... a list such as "4,0 4,8 0,4"
    --no-truth      leave truth.pfm and light_field.yaml as they are
    --view-truths L also write view_truths/truth_RR_CC.png for a list of views
                    such as "0,4 8,4 4,0 4,8"
    --seed N        seed of the sampling noise                (default 1)
    --threads N     render threads, 0 = all                   (default 0)

The scene is wholly procedural (a courtyard: table, chair, trellis, walls), so
that nothing but this file and Blender 3.4 or newer is needed.

Geometry: the camera of view (row t, column s) is moved by (s - 4) b along its
own x axis (right) and (t - 4) b downwards, without rotation, and its sensor is
shifted so that the plane at the focus distance F stays in place.  A point at
depth Z (along the optical axis), seen at (x, y) in the centre view, therefore
stands at (x - (s - 4) d, y - (t - 4) d) in view (t, s), with
d = f b (1/Z - 1/F), f in pixels, and pixel centres at whole numbers.

The depth for the truth is rendered in a pass of its own with a single sample
at the centre of each pixel, so that it never mixes two surfaces.
"""

import argparse
import math
import os
import random
import struct
import sys
import tempfile
import zlib

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

GRID = 9                 # views per side; the reference is the one in the middle
FOCAL_AT_512 = 700.0     # focal length in pixels of a view 512 pixels wide
BASELINE = 0.016         # metres between adjacent views
FOCUS = 3.2              # metres, plane of zero disparity
CAMERA_AT = Vector((0.0, 0.0, 1.5))
CAMERA_PITCH = math.radians(11.0)   # downwards


# ---------------------------------------------------------------- materials --

class Shader:
    """A few words for writing node trees down."""

    def __init__(self, name, roughness=0.7, specular=0.25):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.bsdf = self.tree.nodes['Principled BSDF']
        self.bsdf.inputs['Roughness'].default_value = roughness
        self.bsdf.inputs['Specular'].default_value = specular
        self._coordinates = None

    def node(self, kind, **inputs):
        node = self.tree.nodes.new('ShaderNode' + kind)
        for key, value in inputs.items():
            self.put(node.inputs[key.replace('_', ' ')], value)
        return node

    def put(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif isinstance(value, tuple) and len(value) == 3 and socket.type == 'RGBA':
            socket.default_value = value + (1.0,)
        else:
            socket.default_value = value

    def coordinates(self, scale=(1, 1, 1), rotation=(0, 0, 0)):
        """Object coordinates: metres in the frame of the object."""
        if self._coordinates is None:
            self._coordinates = self.node('TexCoord').outputs['Object']
        return self.node('Mapping', Vector=self._coordinates, Scale=scale,
                         Rotation=rotation).outputs['Vector']

    def math(self, operation, a, b=0.0):
        node = self.node('Math')
        node.operation = operation
        self.put(node.inputs[0], a)
        self.put(node.inputs[1], b)
        return node.outputs[0]

    def noise(self, vector, scale, detail=4.0, distortion=0.0):
        return self.node('TexNoise', Vector=vector, Scale=scale, Detail=detail,
                         Distortion=distortion).outputs['Fac']

    def ramp(self, value, *stops):
        node = self.node('ValToRGB', Fac=value)
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(0.5)
        for element, (position, colour) in zip(elements, stops):
            element.position = position
            element.color = tuple(colour) + (1.0,)
        return node.outputs['Color']

    def mix(self, factor, a, b, blend='MIX'):
        node = self.node('MixRGB')
        node.blend_type = blend
        for socket, value in zip(node.inputs, (factor, a, b)):
            self.put(socket, value)
        return node.outputs['Color']

    def colour(self, value):
        self.put(self.bsdf.inputs['Base Color'], value)
        return self

    def bump(self, height, strength=0.3, distance=0.01):
        node = self.node('Bump', Height=height, Strength=strength, Distance=distance)
        self.put(self.bsdf.inputs['Normal'], node.outputs['Normal'])
        return self


def plain(name, colour, **keywords):
    return Shader(name, **keywords).colour(colour).material


def wood(name, dark, light, grain=9.0, along='x', **keywords):
    """Grain along one axis of the object."""
    s = Shader(name, **keywords)
    stretch = {'x': (0.07, 1, 1), 'y': (1, 0.07, 1), 'z': (1, 1, 0.07)}[along]
    vector = s.coordinates(scale=stretch)
    coarse = s.noise(vector, grain * 2.5, 6.0, 1.2)
    fine = s.noise(vector, grain * 22.0, 3.0)
    colour = s.ramp(coarse, (0.32, dark), (0.68, light))
    colour = s.mix(0.55, colour, s.ramp(fine, (0.3, (0.45, 0.45, 0.45)), (0.65, (1, 1, 1))),
                   'MULTIPLY')
    return s.colour(colour).bump(fine, 0.25, 0.004).material


def brick_material():
    s = Shader('brick', roughness=0.9, specular=0.1)
    vector = s.coordinates()
    node = s.node('TexBrick', Vector=vector, Scale=1.0, Color1=(0.30, 0.085, 0.05),
                  Color2=(0.56, 0.24, 0.13), Mortar=(0.50, 0.46, 0.40),
                  Mortar_Size=0.009, Mortar_Smooth=0.3, Brick_Width=0.26,
                  Row_Height=0.088)
    blotch = s.noise(vector, 3.0, 5.0, 0.5)
    grit = s.noise(vector, 45.0, 4.0)
    colour = s.mix(0.8, node.outputs['Color'],
                   s.ramp(grit, (0.3, (0.45, 0.42, 0.4)), (0.68, (1.15, 1.1, 1.05))),
                   'MULTIPLY')
    colour = s.mix(s.ramp(blotch, (0.52, (0, 0, 0)), (0.75, (0.5, 0.5, 0.5))),
                   colour, (0.62, 0.52, 0.44))
    height = s.math('SUBTRACT', s.math('MULTIPLY', grit, 0.4), node.outputs['Fac'])
    return s.colour(colour).bump(height, 0.7, 0.012).material


def paving_material():
    s = Shader('paving', roughness=0.75, specular=0.2)
    vector = s.coordinates(rotation=(0, 0, math.radians(34)))
    node = s.node('TexBrick', Vector=vector, Scale=1.0, Color1=(0.47, 0.41, 0.33),
                  Color2=(0.66, 0.55, 0.42), Mortar=(0.16, 0.15, 0.12),
                  Mortar_Size=0.012, Mortar_Smooth=0.4, Brick_Width=0.42,
                  Row_Height=0.42)
    node.offset = 0.5
    clouds = s.noise(vector, 6.0, 8.0, 0.8)
    grit = s.noise(vector, 60.0, 4.0)
    colour = s.mix(0.9, node.outputs['Color'],
                   s.ramp(clouds, (0.3, (0.42, 0.40, 0.40)), (0.7, (1.1, 1.05, 0.98))),
                   'MULTIPLY')
    colour = s.mix(0.6, colour,
                   s.ramp(grit, (0.33, (0.4, 0.4, 0.4)), (0.62, (1.05, 1.05, 1.05))),
                   'MULTIPLY')
    height = s.math('SUBTRACT', s.math('MULTIPLY', clouds, 0.5), node.outputs['Fac'])
    return s.colour(colour).bump(height, 0.5, 0.01).material


def marble_material():
    s = Shader('marble', roughness=0.35, specular=0.35)
    vector = s.coordinates()
    veins = s.node('TexWave', Vector=vector, Scale=5.0, Distortion=13.0, Detail=5.0,
                   Detail_Scale=2.2).outputs['Fac']
    colour = s.ramp(veins, (0.0, (0.05, 0.09, 0.09)), (0.16, (0.30, 0.38, 0.36)),
                    (0.45, (0.80, 0.80, 0.76)), (1.0, (0.90, 0.89, 0.85)))
    return s.colour(colour).material


def glaze_material():
    """Speckled blue-green pottery glaze."""
    s = Shader('glaze', roughness=0.4, specular=0.35)
    vector = s.coordinates()
    run = s.noise(vector, 5.0, 6.0, 1.5)
    speckle = s.node('TexVoronoi', Vector=vector, Scale=44.0).outputs['Distance']
    colour = s.ramp(run, (0.3, (0.01, 0.11, 0.16)), (0.5, (0.03, 0.33, 0.36)),
                    (0.7, (0.30, 0.62, 0.50)))
    colour = s.mix(s.ramp(speckle, (0.14, (0.75, 0.75, 0.75)), (0.26, (0, 0, 0))),
                   colour, (0.86, 0.74, 0.48))
    return s.colour(colour).material


def gingham_material():
    """Checker cloth from the cloth's own flat coordinates (the UV map)."""
    s = Shader('gingham', roughness=0.95, specular=0.05)
    uv = s.node('TexCoord').outputs['UV']
    x, y, _ = s.node('SeparateXYZ', Vector=uv).outputs

    def stripe(value):
        return s.math('GREATER_THAN', s.math('FRACT', s.math('MULTIPLY', value, 11.0)), 0.5)

    both = s.math('MULTIPLY', s.math('ADD', stripe(x), stripe(y)), 0.5)
    colour = s.ramp(both, (0.0, (0.86, 0.83, 0.76)), (0.5, (0.62, 0.13, 0.11)),
                    (1.0, (0.33, 0.015, 0.03)))
    weave = s.noise(uv, 70.0, 5.0)
    colour = s.mix(0.8, colour,
                   s.ramp(weave, (0.3, (0.55, 0.55, 0.55)), (0.65, (1.05, 1.05, 1.05))),
                   'MULTIPLY')
    return s.colour(colour).bump(weave, 0.3, 0.004).material


def terracotta_material():
    s = Shader('terracotta', roughness=0.85, specular=0.1)
    vector = s.coordinates()
    stain = s.noise(vector, 7.0, 7.0, 0.7)
    grain = s.noise(vector, 70.0, 3.0)
    colour = s.ramp(stain, (0.3, (0.36, 0.12, 0.06)), (0.55, (0.60, 0.24, 0.12)),
                    (0.75, (0.74, 0.50, 0.36)))
    colour = s.mix(0.5, colour, s.ramp(grain, (0.35, (0.5, 0.5, 0.5)), (0.6, (1, 1, 1))),
                   'MULTIPLY')
    return s.colour(colour).bump(grain, 0.3, 0.004).material


def leaf_material(name, dark, light):
    """Every leaf (mesh island) in a shade of its own, with a few veins."""
    s = Shader(name, roughness=0.55, specular=0.25)
    shade = s.node('NewGeometry').outputs['Random Per Island']
    colour = s.ramp(shade, (0.0, dark), (1.0, light))
    mottle = s.noise(s.coordinates(), 38.0, 4.0)
    colour = s.mix(0.6, colour,
                   s.ramp(mottle, (0.32, (0.5, 0.55, 0.45)), (0.66, (1.15, 1.1, 1.0))),
                   'MULTIPLY')
    return s.colour(colour).material


def fruit_material(name, low, high, scale):
    s = Shader(name, roughness=0.4, specular=0.3)
    vector = s.coordinates()
    colour = s.ramp(s.noise(vector, scale, 6.0, 0.6), (0.32, low), (0.68, high))
    return s.colour(colour).bump(s.noise(vector, 90.0, 2.0), 0.25, 0.003).material


# ----------------------------------------------------------------- geometry --

def add(name, vertices, faces, material, smooth=False, place=Matrix.Identity(4)):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], [], faces)
    mesh.polygons.foreach_set('use_smooth', [smooth] * len(mesh.polygons))
    mesh.materials.append(material)
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    thing.matrix_world = place
    bpy.context.collection.objects.link(thing)
    return thing


def at(x, y, z, turn=(0, 0, 0)):
    rotation = Euler([math.radians(angle) for angle in turn])
    return Matrix.Translation((x, y, z)) @ rotation.to_matrix().to_4x4()


def box(name, size, place, material, bevel=0.004):
    x, y, z = (0.5 * v for v in size)
    vertices = [(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    thing = add(name, vertices, faces, material, place=place)
    if bevel:
        modifier = thing.modifiers.new('bevel', 'BEVEL')
        modifier.width = bevel
        modifier.segments = 2
    return thing


def lathe(name, profile, place, material, segments=72):
    """Turn a profile of (radius, height) about z."""
    vertices, faces = [], []
    for radius, height in profile:
        for i in range(segments):
            a = 2 * math.pi * i / segments
            vertices.append((radius * math.cos(a), radius * math.sin(a), height))
    for k in range(len(profile) - 1):
        for i in range(segments):
            j = (i + 1) % segments
            faces.append((k * segments + i, k * segments + j,
                          (k + 1) * segments + j, (k + 1) * segments + i))
    thing = add(name, vertices, faces, material, True, place)
    thing.data.use_auto_smooth = True
    thing.data.auto_smooth_angle = math.radians(40)
    return thing


def ball(name, radius, place, material, stretch=(1, 1, 1)):
    rows, columns = 48, 96
    vertices, faces = [], []
    for k in range(rows + 1):
        p = math.pi * k / rows
        for i in range(columns):
            a = 2 * math.pi * i / columns
            vertices.append((radius * stretch[0] * math.sin(p) * math.cos(a),
                             radius * stretch[1] * math.sin(p) * math.sin(a),
                             radius * stretch[2] * math.cos(p)))
    for k in range(rows):
        for i in range(columns):
            j = (i + 1) % columns
            faces.append((k * columns + i, (k + 1) * columns + i,
                          (k + 1) * columns + j, k * columns + j))
    return add(name, vertices, faces, material, True, place)


def tube(name, points, radius, material, sides=10):
    """A round rod along a list of points."""
    points = [Vector(p) for p in points]
    vertices, faces = [], []
    for k, point in enumerate(points):
        tangent = (points[min(k + 1, len(points) - 1)] - points[max(k - 1, 0)]).normalized()
        helper = Vector((0, 0, 1)) if abs(tangent.z) < 0.9 else Vector((1, 0, 0))
        u = tangent.cross(helper).normalized()
        v = tangent.cross(u)
        for i in range(sides):
            a = 2 * math.pi * i / sides
            vertices.append(point + radius * (math.cos(a) * u + math.sin(a) * v))
    for k in range(len(points) - 1):
        for i in range(sides):
            j = (i + 1) % sides
            faces.append((k * sides + i, k * sides + j, (k + 1) * sides + j, (k + 1) * sides + i))
    return add(name, vertices, faces, material, True)


def leaf(vertices, faces, base, along, normal, length, width, bend=0.3, fold=0.15, steps=8,
         blunt=0.75):
    """Append one leaf: from base along a direction, bending away from its normal."""
    along = along.normalized()
    side = along.cross(normal)
    if side.length < 1e-3:
        side = along.cross(Vector((0.3, 0.8, 0.5)))
    side.normalize()
    normal = side.cross(along)
    first = len(vertices)
    for k in range(steps + 1):
        t = k / steps
        half = 0.5 * width * (math.sin(math.pi * t ** blunt) + 0.04 * (1 - t))
        middle = base + length * (t * along - bend * t * t * normal)
        lift = fold * half * normal
        vertices.extend((middle - half * side + lift, middle, middle + half * side + lift))
    for k in range(steps):
        a = first + 3 * k
        faces.extend(((a, a + 1, a + 4, a + 3), (a + 1, a + 2, a + 5, a + 4)))


# -------------------------------------------------------------------- scene --

def build_room(m):
    """Paved floor, brick wall on the left, plain plaster wall on the right."""
    add('floor', [(-12, -6, 0), (12, -6, 0), (12, 12, 0), (-12, 12, 0)], [(0, 1, 2, 3)],
        m['paving'])

    def wall(name, start, end, height, material):
        start, end = Vector(start), Vector(end)
        direction = end - start
        place = (Matrix.Translation((start.x, start.y, 0))
                 @ Matrix.Rotation(math.atan2(direction.y, direction.x), 4, 'Z')
                 @ Matrix.Rotation(math.radians(90), 4, 'X'))
        length = direction.length
        return add(name, [(0, 0, 0), (length, 0, 0), (length, height, 0), (0, height, 0)],
                   [(0, 1, 2, 3)], material, place=place), place

    corner = (1.25, 7.7)
    _, brick = wall('brick wall', (-4.6, 6.1), corner, 3.4, m['brick'])
    wall('plaster wall', corner, (3.4, 3.6), 3.4, m['plaster'])

    # A door of planks in the brick wall (frame of the wall: x along, y up, z out).
    for i in range(5):
        box('door plank', (0.17, 2.02, 0.04), brick @ at(4.72 + 0.175 * i, 1.01, 0.03),
            m['door'], 0.008)
    for x in (4.58, 5.56):
        box('door jamb', (0.1, 2.15, 0.1), brick @ at(x, 1.07, 0.04), m['oak y'])
    box('door lintel', (1.16, 0.14, 0.12), brick @ at(5.07, 2.18, 0.05), m['oak x'])
    for y in (0.45, 1.55):
        box('door rail', (0.86, 0.11, 0.03), brick @ at(5.07, y, 0.065), m['door x'])
    ball('door knob', 0.04, brick @ at(5.4, 1.0, 0.12), m['brass'])


def build_table(m, rng):
    """A round table under a checker cloth, with the still life on it."""
    centre = Vector((-0.33, 2.68, 0.0))
    radius, top, drop = 0.60, 0.76, 0.34

    rings, segments = 60, 288
    vertices, faces, flat = [], [], []
    for k in range(rings + 1):
        r = (radius + drop) * k / rings
        for i in range(segments):
            a = 2 * math.pi * i / segments
            over = r - radius
            if over <= 0:
                rr, z = r, top
            else:   # a rounded edge, then folds that grow downwards
                edge = 0.02
                if over < edge * math.pi / 2:
                    rr = radius + edge * math.sin(over / edge)
                    z = top - edge * (1 - math.cos(over / edge))
                else:
                    down = over - edge * math.pi / 2
                    wave = math.sin(13 * a + 0.8 * math.sin(3 * a)) + 0.4 * math.sin(5 * a + 1)
                    rr = radius + edge + (0.05 + 0.05 * wave) * min(1.0, down / 0.25)
                    z = top - edge - down
            vertices.append((centre.x + rr * math.cos(a), centre.y + rr * math.sin(a), z))
            flat.append((r * math.cos(a + 0.5), r * math.sin(a + 0.5)))
    for k in range(rings):
        for i in range(segments):
            j = (i + 1) % segments
            faces.append((k * segments + i, (k + 1) * segments + i,
                          (k + 1) * segments + j, k * segments + j))
    cloth = add('cloth', vertices, faces, m['gingham'], True)
    uv = cloth.data.uv_layers.new(name='flat')
    for loop in cloth.data.loops:
        uv.data[loop.index].uv = flat[loop.vertex_index]
    lathe('table leg', [(0.0, 0.0), (0.24, 0.0), (0.24, 0.035), (0.2, 0.05), (0.06, 0.1),
                        (0.045, 0.3), (0.06, 0.6), (0.2, 0.7)],
          at(centre.x, centre.y, 0), m['oak z'])

    top += 0.001

    # Suzanne in glazed pottery, on two books.
    box('book', (0.34, 0.25, 0.045), at(-0.60, 2.80, top + 0.0225, (0, 0, 14)), m['book a'], 0.003)
    box('book', (0.30, 0.22, 0.035), at(-0.61, 2.81, top + 0.0625, (0, 0, 3)), m['book b'], 0.003)
    bpy.ops.mesh.primitive_monkey_add(size=0.34)
    monkey = bpy.context.object
    monkey.matrix_world = at(-0.60, 2.79, top + 0.228, (-17, 0, 22))
    modifier = monkey.modifiers.new('smooth', 'SUBSURF')
    modifier.levels = modifier.render_levels = 3
    bpy.ops.object.shade_smooth()
    monkey.data.materials.append(m['glaze'])

    # A marble ball, a torus leaning on it, fruit.
    ball('marble ball', 0.115, at(-0.14, 2.47, top + 0.115, (20, 30, 0)), m['marble'])
    bpy.ops.mesh.primitive_torus_add(major_radius=0.098, minor_radius=0.034,
                                     major_segments=128, minor_segments=48)
    torus = bpy.context.object
    torus.matrix_world = at(-0.40, 2.37, top + 0.036, (3, -2, 0))
    bpy.ops.object.shade_smooth()
    torus.data.materials.append(m['torus'])
    ball('orange', 0.052, at(-0.675, 2.47, top + 0.05, (10, 30, 0)), m['orange'], (1, 1, 0.95))
    ball('orange', 0.050, at(-0.575, 2.44, top + 0.048, (70, 10, 0)), m['orange'], (1, 1, 0.95))
    ball('lemon', 0.041, at(-0.655, 2.37, top + 0.04, (0, 4, 35)), m['lemon'], (1.35, 1, 1))
    ball('plum', 0.036, at(-0.40, 2.37, top + 0.035), m['plum'])

    # A vase of flowers and twigs.
    foot = Vector((-0.10, 2.92, top))
    lathe('vase', [(0.0, 0.0), (0.055, 0.0), (0.062, 0.01), (0.09, 0.06), (0.1, 0.11),
                   (0.085, 0.17), (0.05, 0.22), (0.042, 0.25), (0.055, 0.275), (0.048, 0.275),
                   (0.036, 0.25)], at(*foot), m['vase'])
    leaves, leaf_faces = [], []
    petals, petal_faces = [], []
    for n in range(11):
        angle = 2 * math.pi * n / 11 + rng.uniform(-0.2, 0.2)
        reach = rng.uniform(0.10, 0.30)
        height = rng.uniform(0.42, 0.68)
        out = Vector((math.cos(angle), 0.7 * math.sin(angle), 0))
        stem = []
        for k in range(13):
            t = k / 12
            stem.append(foot + Vector((0, 0, 0.12 + height * t)) + out * (reach * t ** 1.8))
        tube('stem', stem, 0.0035, m['stem'], 8)
        tip = stem[-1]
        direction = (stem[-1] - stem[-2]).normalized()
        for k in range(5, 12):
            for sign in (-1, 1):
                if rng.random() < 0.8:
                    side = direction.cross(Vector((0.2, -1, 0.3))).normalized() * sign
                    way = side + 0.6 * direction + 0.3 * Vector(
                        [rng.uniform(-1, 1) for _ in range(3)])
                    leaf(leaves, leaf_faces, stem[k], way, Vector((0, -0.8, 0.6)),
                         rng.uniform(0.05, 0.085), rng.uniform(0.024, 0.036), 0.2)
        if n % 3 != 2:
            face = (direction + Vector((0.0, -1.0, 0.5))).normalized()
            u = face.cross(Vector((1, 0.1, 0))).normalized()
            v = face.cross(u)
            for k in range(11):
                a = 2 * math.pi * k / 11
                leaf(petals, petal_faces, tip, math.cos(a) * u + math.sin(a) * v, face,
                     0.046, 0.019, 0.15, 0.1, 5, 1.3)
            ball('flower eye', 0.013, at(*(tip + 0.004 * face)), m['yellow'])
    add('twig leaves', leaves, leaf_faces, m['leaf b'], True)
    add('petals', petals, petal_faces, m['petal'], True)


def build_chair(m):
    """A garden chair with a back of slats."""
    frame = at(0.82, 3.72, 0, (0, 0, 208))
    h = 0.44
    for x in (-0.2, 0.2):
        box('leg', (0.04, 0.04, h), frame @ at(x, 0.2, h / 2), m['blue'])
        box('post', (0.04, 0.045, 0.62), frame @ at(x, -0.245, h + 0.28, (12, 0, 0)), m['blue'])
        box('leg', (0.04, 0.04, h), frame @ at(x, -0.19, h / 2, (4, 0, 0)), m['blue'])
        box('stretcher', (0.025, 0.4, 0.03), frame @ at(x, 0, 0.18), m['blue'])
    for k in range(6):
        box('seat slat', (0.45, 0.055, 0.02), frame @ at(0, -0.19 + 0.078 * k, h), m['oak x'])
    box('apron', (0.4, 0.025, 0.05), frame @ at(0, 0.2, h - 0.05), m['blue'])
    back = frame @ at(0, -0.19, h, (12, 0, 0))
    box('rail', (0.44, 0.035, 0.07), back @ at(0, 0, 0.56), m['blue'])
    box('rail', (0.4, 0.03, 0.045), back @ at(0, 0, 0.14), m['blue'])
    for k in range(6):
        box('back slat', (0.028, 0.014, 0.42), back @ at(-0.145 + 0.058 * k, 0, 0.35), m['blue'])


def build_trellis(m, rng):
    """A diamond lattice in front of the brick wall, with a climbing plant."""
    left, right, bottom, height, depth = -2.05, -0.34, 0.12, 2.16, 5.25
    place = at(0, depth, 0)
    width, top = right - left, bottom + height
    for x in (left, right):
        box('post', (0.06, 0.06, top + 0.08), at(x, depth, (top + 0.08) / 2), m['pine z'])
    for z in (bottom, top):
        box('bar', (width, 0.05, 0.055), at((left + right) / 2, depth, z), m['pine x'])
    slats = []
    step = 0.27
    for sign in (-1, 1):
        c = -3 * height
        while c < width + 3 * height:
            # the line x = c + sign * z, clipped to the frame
            low = max(0.0, (0 - c) if sign > 0 else (c - width))
            high = min(height, (width - c) if sign > 0 else c)
            if high - low > 0.04:
                a = Vector((left + c + sign * low, 0, bottom + low))
                b = Vector((left + c + sign * high, 0, bottom + high))
                middle, length = (a + b) / 2, (b - a).length
                box('slat', (length, 0.012, 0.032),
                    place @ at(middle.x, -0.008 * sign, middle.z, (0, -45 * sign, 0)),
                    m['pine x'], 0.002)
                slats.append((a, b))
            c += step
    vertices, faces = [], []
    for a, b in slats:
        for _ in range(int(26 * (b - a).length)):
            p = a.lerp(b, rng.random())
            u, w = (p.x - left) / width, (p.z - bottom) / height
            # dense at the foot on the left and along the upper edge
            density = max(1.25 * (1 - 1.1 * u - 0.75 * w), 0.9 * math.exp(-((w - 1.0) / 0.16) ** 2)
                          * (1.1 - u))
            if rng.random() > density:
                continue
            p = Vector((p.x, depth + rng.uniform(-0.10, 0.02), p.z))
            way = Vector((rng.uniform(-1, 1), rng.uniform(-0.5, 0.1), rng.uniform(-1.2, 0.3)))
            leaf(vertices, faces, p, way, Vector((rng.uniform(-0.5, 0.5), -1, 0.5)),
                 rng.uniform(0.09, 0.15), rng.uniform(0.06, 0.10), 0.25)
    add('climber', vertices, faces, m['leaf a'], True)


def pot(name, radius, height, x, y, m):
    lathe(name, [(0.0, 0.0), (0.66 * radius, 0.0), (0.93 * radius, 0.82 * height),
                 (1.03 * radius, 0.82 * height), (1.05 * radius, height),
                 (0.92 * radius, height), (0.9 * radius, 0.9 * height), (0.0, 0.88 * height)],
          at(x, y, 0), m['terracotta'])


def build_plants(m, rng):
    # blades in the corner
    pot('corner pot', 0.24, 0.42, 1.28, 6.45, m)
    vertices, faces = [], []
    for n in range(24):
        a = 2.4 * n
        tilt = 0.25 + 0.75 * (n / 24)
        way = Vector((math.cos(a) * tilt, math.sin(a) * tilt, 1.0))
        normal = Vector((-math.cos(a), -math.sin(a), 0.7))
        leaf(vertices, faces, Vector((1.28 + 0.05 * math.cos(a), 6.45 + 0.05 * math.sin(a), 0.36)),
             way, normal, rng.uniform(0.8, 1.2), 0.125, 0.25 + 0.25 * tilt, 0.3, 14, 0.55)
    add('blades', vertices, faces, m['leaf c'], True)

    # a bush of round leaves between trellis and table
    pot('bush pot', 0.17, 0.32, 0.10, 6.15, m)
    vertices, faces = [], []
    for n in range(150):
        a, b = rng.uniform(0, 2 * math.pi), rng.uniform(-0.4, 1.0)
        out = Vector((math.cos(a) * math.sqrt(1 - b * b), math.sin(a) * math.sqrt(1 - b * b), b))
        base = Vector((0.10, 6.15, 0.55)) + out * rng.uniform(0.05, 0.22)
        leaf(vertices, faces, base, out + Vector((0, 0, -0.3)), out + Vector((0, -0.4, 0.8)),
             0.12, 0.07, 0.35)
    add('bush', vertices, faces, m['leaf b'], True)


def build_rest(m, rng):
    # the textureless ball on a stone pedestal
    lathe('pedestal', [(0.0, 0.0), (0.2, 0.0), (0.2, 0.07), (0.15, 0.1), (0.14, 0.58),
                       (0.19, 0.62), (0.19, 0.68), (0.0, 0.68)], at(0.34, 5.05, 0), m['stone'])
    ball('plain ball', 0.2, at(0.34, 5.05, 0.875), m['yellow'])

    # pennants on a string across the yard
    start, end = Vector((-2.3, 5.3, 2.50)), Vector((2.3, 5.4, 2.62))
    line = []
    for k in range(81):
        t = k / 80
        p = start.lerp(end, t)
        p.y += 0.25 * math.sin(math.pi * t)
        p.z -= 0.36 * 4 * t * (1 - t)
        line.append(p)
    tube('string', line, 0.006, m['string'], 8)
    for k in range(19):
        i = 4 + 4 * k
        a, b = line[i - 1], line[min(i + 2, 80)]
        tip = (a + b) / 2 + Vector((rng.uniform(-0.02, 0.02), rng.uniform(-0.05, 0.05), -0.2))
        add('pennant', [a, b, tip], [(0, 2, 1)], m['pennant %d' % (k % 5)])

    # a bucket of apples beside the chair
    lathe('bucket', [(0.0, 0.005), (0.095, 0.0), (0.13, 0.24), (0.138, 0.24), (0.138, 0.25),
                     (0.12, 0.25), (0.09, 0.02)], at(0.98, 3.05, 0), m['zinc'])
    tube('handle', [Vector((0.98 + 0.133 * math.cos(a), 3.05 + 0.03 * math.sin(a),
                            0.235 + 0.13 * math.sin(a)))
                    for a in [math.pi * k / 24 for k in range(25)]], 0.005, m['string'], 10)
    for n in range(7):
        ball('apple', 0.045, at(0.98 + 0.066 * math.cos(n), 3.05 + 0.066 * math.sin(n), 0.225),
             m['apple'])


def build_light(scene):
    world = scene.world or bpy.data.worlds.new('World')
    scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes['Background']
    background.inputs['Color'].default_value = (0.70, 0.80, 1.0, 1.0)
    background.inputs['Strength'].default_value = 0.6

    data = bpy.data.lights.new('sun', 'SUN')
    data.energy = 4.2
    data.color = (1.0, 0.88, 0.72)
    data.angle = math.radians(3.0)
    sun = bpy.data.objects.new('sun', data)
    direction = Vector((0.72, 0.62, -0.80))
    sun.matrix_world = direction.to_track_quat('-Z', 'Y').to_matrix().to_4x4()
    bpy.context.collection.objects.link(sun)


def build_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    rng = random.Random(7)
    m = {
        'brick': brick_material(),
        'paving': paving_material(),
        'plaster': plain('plaster', (0.80, 0.60, 0.38), roughness=1.0, specular=0.0),
        'door': wood('door', (0.05, 0.14, 0.10), (0.14, 0.36, 0.25), along='y'),
        'door x': wood('door x', (0.05, 0.14, 0.10), (0.14, 0.36, 0.25), along='x'),
        'brass': plain('brass', (0.65, 0.45, 0.12), roughness=0.45),
        'gingham': gingham_material(),
        'glaze': glaze_material(),
        'marble': marble_material(),
        'terracotta': terracotta_material(),
        'torus': wood('torus', (0.16, 0.06, 0.025), (0.62, 0.34, 0.14), grain=14.0),
        'orange': fruit_material('orange', (0.72, 0.20, 0.01), (0.90, 0.38, 0.02), 9.0),
        'lemon': fruit_material('lemon', (0.75, 0.50, 0.02), (0.88, 0.70, 0.07), 12.0),
        'plum': fruit_material('plum', (0.09, 0.015, 0.06), (0.28, 0.05, 0.15), 22.0),
        'apple': fruit_material('apple', (0.42, 0.02, 0.02), (0.72, 0.25, 0.05), 12.0),
        'vase': fruit_material('vase', (0.60, 0.55, 0.44), (0.82, 0.78, 0.68), 25.0),
        'stone': fruit_material('stone', (0.26, 0.25, 0.23), (0.60, 0.57, 0.52), 16.0),
        'zinc': fruit_material('zinc', (0.30, 0.33, 0.35), (0.58, 0.61, 0.62), 18.0),
        'book a': fruit_material('book a', (0.05, 0.10, 0.26), (0.10, 0.18, 0.40), 30.0),
        'book b': fruit_material('book b', (0.40, 0.28, 0.10), (0.62, 0.47, 0.20), 30.0),
        'stem': plain('stem', (0.10, 0.16, 0.04)),
        'yellow': plain('yellow', (0.86, 0.52, 0.04), roughness=0.6, specular=0.15),
        'string': plain('string', (0.12, 0.10, 0.08)),
        'petal': leaf_material('petal', (0.86, 0.80, 0.86), (0.72, 0.42, 0.68)),
        'leaf a': leaf_material('leaf a', (0.04, 0.13, 0.02), (0.27, 0.42, 0.06)),
        'leaf b': leaf_material('leaf b', (0.07, 0.19, 0.07), (0.24, 0.40, 0.17)),
        'leaf c': leaf_material('leaf c', (0.03, 0.15, 0.06), (0.20, 0.44, 0.12)),
    }
    for axis in 'xyz':
        m['oak ' + axis] = wood('oak ' + axis, (0.22, 0.10, 0.04), (0.58, 0.34, 0.16), along=axis)
    for axis in 'xz':
        m['pine ' + axis] = wood('pine ' + axis, (0.50, 0.38, 0.24), (0.84, 0.75, 0.60), along=axis)
    m['blue'] = wood('blue', (0.03, 0.14, 0.30), (0.09, 0.33, 0.56), along='z')
    for k, colour in enumerate([(0.75, 0.12, 0.08), (0.85, 0.60, 0.08), (0.07, 0.36, 0.50),
                                (0.82, 0.78, 0.70), (0.16, 0.42, 0.16)]):
        dark = tuple(0.6 * v for v in colour)
        m['pennant %d' % k] = fruit_material('pennant %d' % k, dark, colour, 40.0)

    build_room(m)
    build_table(m, rng)
    build_chair(m)
    build_trellis(m, rng)
    build_plants(m, rng)
    build_rest(m, rng)
    build_light(scene)
    return scene


# ---------------------------------------------------------------- rendering --

def set_up(scene, size, samples, threads):
    scene.render.engine = 'CYCLES'
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.use_persistent_data = True
    scene.render.dither_intensity = 0.0
    scene.render.image_settings.file_format = 'PNG'
    scene.render.image_settings.color_mode = 'RGB'
    scene.render.image_settings.color_depth = '8'
    scene.render.image_settings.compression = 100
    if threads:
        scene.render.threads_mode = 'FIXED'
        scene.render.threads = threads
    scene.view_settings.view_transform = 'Filmic'
    scene.view_settings.look = 'High Contrast'
    scene.view_settings.exposure = 0.2
    cycles = scene.cycles
    cycles.device = 'CPU'
    cycles.samples = samples
    cycles.use_adaptive_sampling = True
    cycles.adaptive_threshold = 0.02
    cycles.adaptive_min_samples = 24
    cycles.use_denoising = False
    cycles.max_bounces = 1
    cycles.diffuse_bounces = 1
    cycles.glossy_bounces = 1
    cycles.transmission_bounces = 0
    cycles.sample_clamp_indirect = 2.0
    cycles.blur_glossy = 1.0
    cycles.caustics_reflective = False
    cycles.caustics_refractive = False

    data = bpy.data.cameras.new('camera')
    data.sensor_fit = 'HORIZONTAL'
    data.sensor_width = 36.0
    data.lens = data.sensor_width * FOCAL_AT_512 / 512.0
    data.clip_start = 0.05
    camera = bpy.data.objects.new('camera', data)
    bpy.context.collection.objects.link(camera)
    scene.camera = camera
    return camera


def place_camera(camera, row, column):
    """Move the camera in its own plane; shift the sensor to keep the focus plane."""
    right = (column - GRID // 2) * BASELINE
    down = (row - GRID // 2) * BASELINE
    rotation = Matrix.Rotation(math.radians(90) - CAMERA_PITCH, 4, 'X')
    camera.matrix_world = Matrix.Translation(CAMERA_AT) @ rotation @ Matrix.Translation(
        (right, -down, 0.0))
    # Blender's shift is in units of the sensor's width, right and up.
    per_metre = FOCAL_AT_512 / 512.0 / FOCUS
    camera.data.shift_x = -right * per_metre
    camera.data.shift_y = down * per_metre


def render_depth(scene, camera, row=GRID // 2, column=GRID // 2):
    """Depth along the axis in metres, one sample at each pixel's centre; rows bottom to top."""
    place_camera(camera, row, column)
    cycles = scene.cycles
    kept = (cycles.samples, cycles.use_adaptive_sampling, cycles.filter_width, cycles.max_bounces)
    cycles.samples, cycles.use_adaptive_sampling, cycles.filter_width, cycles.max_bounces = (
        1, False, 0.01, 0)
    layer = scene.view_layers[0]
    layer.use_pass_z = True
    scene.use_nodes = True
    nodes, links = scene.node_tree.nodes, scene.node_tree.links
    nodes.clear()
    layers = nodes.new('CompositorNodeRLayers')
    size = scene.render.resolution_x
    with tempfile.TemporaryDirectory() as folder:
        output = nodes.new('CompositorNodeOutputFile')
        output.base_path = folder
        output.format.file_format = 'OPEN_EXR'
        output.format.color_mode = 'RGB'
        output.format.color_depth = '32'    # the default would be half precision
        output.file_slots[0].path = 'depth'
        links.new(layers.outputs['Depth'], output.inputs[0])
        bpy.ops.render.render()
        (name,) = os.listdir(folder)
        image = bpy.data.images.load(os.path.join(folder, name))
        image.colorspace_settings.name = 'Non-Color'
        pixels = np.empty(size * size * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        depth = pixels.reshape(size, size, image.channels)[:, :, 0].copy()
        bpy.data.images.remove(image)
    scene.use_nodes = False
    layer.use_pass_z = False
    (cycles.samples, cycles.use_adaptive_sampling, cycles.filter_width, cycles.max_bounces) = kept
    if not (depth.min() > 0.1 and depth.max() < 50.0):
        raise RuntimeError('a hole in the scene: depth %g .. %g' % (depth.min(), depth.max()))
    return depth


def drop_texts(path):
    """Take date, render time and the like out of a PNG, so that equal pictures are equal files."""
    with open(path, 'rb') as file:
        data = file.read()
    kept, position = [data[:8]], 8
    while position < len(data):
        end = position + 12 + int.from_bytes(data[position:position + 4], 'big')
        if data[position + 4:position + 8] != b'tEXt':
            kept.append(data[position:end])
        position = end
    with open(path, 'wb') as file:
        file.write(b''.join(kept))


def write_pfm(path, image):
    """Single-channel little-endian PFM from rows bottom to top."""
    with open(path, 'wb') as file:
        file.write(b'Pf\n%d %d\n-1.0\n' % (image.shape[1], image.shape[0]))
        file.write(image.astype('<f4').tobytes())


def write_view_truth(path, disparity):
    """16-bit grey PNG: disparity in pixels = value / 8192 - 4. Rows bottom to top, as Blender has them."""
    size = disparity.shape[0]
    values = np.round((disparity + 4.0) * 8192.0)
    if not (values.min() >= 0 and values.max() <= 65535):
        raise RuntimeError('disparity beyond -4 .. 4 px')
    # By hand, because Blender's own PNGs go through colour management.
    rows = values[::-1].astype('>u2')
    # Each row as differences to the row above (filter 2), which packs best.
    packed = rows.view(np.uint8).reshape(size, 2 * size)
    up = packed.copy()
    up[1:] -= packed[:-1]
    lines = np.concatenate([np.full((size, 1), 2, np.uint8), up], axis=1)

    def chunk(kind, data):
        body = kind + data
        return struct.pack('>I', len(data)) + body + struct.pack('>I', zlib.crc32(body))

    with open(path, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', size, size, 16, 0, 0, 0, 0)) +
                   chunk(b'IDAT', zlib.compress(lines.tobytes(), 9)) + chunk(b'IEND', b''))


def write_description(path, size, focal, disparity):
    centre = (size - 1) / 2
    low = math.floor(disparity.min() * 10) / 10
    high = math.ceil(disparity.max() * 10) / 10
    with open(path, 'w') as file:
        file.write(f'''# Demo light field, rendered by render_demo.py (see README.md). SI units.
# A point at (x, y) in the view in the middle of the grid stands at
# (x - (column - {GRID // 2}) d, y - (row - {GRID // 2}) d) in view (row, column).
pattern: "view_{{row:02}}_{{column:02}}.png"
grid: {{rows: {GRID}, columns: {GRID}}}
focal_length_px: {focal}
principal_point_px: [{centre}, {centre}]   # of the reference view; pixel centres at integers
baseline_m: [{BASELINE}, {BASELINE}]         # between adjacent columns, rows
focus_distance_m: {FOCUS}               # plane of zero disparity
disparity_range: [{low:.1f}, {high:.1f}]        # px between adjacent views
truth: truth.pfm                    # disparity of the reference view
''')


def wanted_views(text):
    middle = GRID // 2
    if text == 'none':
        return []
    if text == 'centre':
        return [(middle, middle)]
    if text == 'grid':
        return [(r, c) for r in range(GRID) for c in range(GRID)]
    if text == 'cross':
        row = [(middle, c) for c in range(GRID)]
        return row + [(r, middle) for r in range(GRID) if r != middle]
    return [tuple(int(v) for v in pair.split(',')) for pair in text.split()]


def main():
    parser = argparse.ArgumentParser(prog='render_demo.py')
    parser.add_argument('output')
    parser.add_argument('--size', type=int, default=512)
    parser.add_argument('--samples', type=int, default=72)
    parser.add_argument('--views', default='cross')
    parser.add_argument('--no-truth', action='store_true')
    parser.add_argument('--view-truths', default='')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--threads', type=int, default=0)
    arguments = sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else ['--help']
    args = parser.parse_args(arguments)

    output = os.path.abspath(args.output)
    os.makedirs(output, exist_ok=True)
    scene = build_scene()
    camera = set_up(scene, args.size, args.samples, args.threads)

    if not args.no_truth:
        focal = FOCAL_AT_512 * args.size / 512
        depth = render_depth(scene, camera).astype(np.float64)
        disparity = focal * BASELINE * (1.0 / depth - 1.0 / FOCUS)
        print('depth %.3f .. %.3f m, disparity %.3f .. %.3f px' % (
            depth.min(), depth.max(), disparity.min(), disparity.max()))
        write_pfm(os.path.join(output, 'truth.pfm'), disparity)
        write_description(os.path.join(output, 'light_field.yaml'), args.size, focal, disparity)

    for row, column in wanted_views(args.view_truths) if args.view_truths else []:
        folder = os.path.join(output, 'view_truths')
        os.makedirs(folder, exist_ok=True)
        depth = render_depth(scene, camera, row, column).astype(np.float64)
        disparity = FOCAL_AT_512 * args.size / 512 * BASELINE * (1.0 / depth - 1.0 / FOCUS)
        write_view_truth(os.path.join(folder, 'truth_%02d_%02d.png' % (row, column)), disparity)

    for row, column in wanted_views(args.views):
        place_camera(camera, row, column)
        # Noise that differs from view to view: equal noise would look like a
        # texture that stands still, and pull a matcher towards zero disparity.
        scene.cycles.seed = args.seed * 1000 + row * GRID + column
        scene.render.filepath = os.path.join(output, 'view_%02d_%02d.png' % (row, column))
        bpy.ops.render.render(write_still=True)
        drop_texts(scene.render.filepath)


main()
