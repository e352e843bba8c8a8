#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the light_field_depth developers
"""Writes the two example robots of launch/array.launch.

usage: data/make_robots.py        (needs numpy and OpenCV for Python)

For each robot

    config/robots/NAME/robot.urdf              its body and the frames of its cameras
    config/robots/NAME/view_<row>_<column>.yaml   the calibration of each camera, as camera_info_manager keeps it
    config/robots/NAME/array.yaml              the array, for the node
    data/robots/NAME/view_<row>_<column>.jpg   what the cameras see
    data/robots/NAME/light_field.yaml          the description that light_field_player reads

The scene is cast ray by ray in the robot's frame base_link (x forward, y to the left, z up, floor at z = 0, metres): a
floor, a wall at x = 4, a red crate on the left, a green one on the right, a blue column, a yellow ball.
"""
import math
import os

import cv2
import numpy as np

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SAMPLES = 3  # a pixel and axis
NEAREST_M, FARTHEST_M = 0.05, 20.0
# From x forward, z up to x right, y down, z forward (REP 103).
OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


class Robot:
    """An array of parallel cameras on a robot; the middle camera is the reference."""

    def __init__(self, name, rows, columns, spacing_m, size, focal_px, at_m, pitch, yaw, body):
        self.name, self.rows, self.columns, self.spacing_m = name, rows, columns, spacing_m
        self.width, self.height = size
        self.focal_px = focal_px
        self.centre_px = ((self.width - 1) / 2, (self.height - 1) / 2)
        self.at_m = np.array(at_m)
        self.pitch, self.yaw = math.radians(pitch), math.radians(yaw)  # down, to the left
        self.body = body  # (name, size, place) of the boxes that it is made of

    def views(self):
        return [(row, column) for row in range(self.rows) for column in range(self.columns)]

    def steps(self, row, column):
        return column - self.columns // 2, row - self.rows // 2

    def rotation(self):
        """From the reference camera's optical frame to base_link."""
        cos_p, sin_p, cos_y, sin_y = math.cos(self.pitch), math.sin(self.pitch), math.cos(self.yaw), math.sin(self.yaw)
        turn = np.array([[cos_y, -sin_y, 0.0], [sin_y, cos_y, 0.0], [0.0, 0.0, 1.0]])
        nod = np.array([[cos_p, 0.0, sin_p], [0.0, 1.0, 0.0], [-sin_p, 0.0, cos_p]])
        return turn @ nod @ OPTICAL


ROBOTS = [
    Robot('grid_3x3', 3, 3, 0.03, (384, 288), 320.0, (0.2, 0.0, 0.9), pitch=25.0, yaw=0.0,
          body=[('body', (0.5, 0.4, 0.25), (0.0, 0.0, 0.185)), ('mast', (0.04, 0.04, 0.6), (0.16, 0.0, 0.61))]),
    Robot('row_1x5', 1, 5, 0.025, (384, 240), 320.0, (0.25, 0.05, 0.35), pitch=5.0, yaw=20.0,
          body=[('body', (0.6, 0.4, 0.16), (0.0, 0.0, 0.14)), ('neck', (0.04, 0.04, 0.16), (0.22, 0.05, 0.28))]),
]


# --------------------------------------------------------------------- scene --

LATTICE = np.random.default_rng(5).random((64, 64, 64)).astype(np.float32)


def noise(points, per_m):
    """Smooth values 0 to 1 that change so many times a metre."""
    place = points * per_m
    low = np.floor(place).astype(int)
    part = place - low
    part = part * part * (3.0 - 2.0 * part)
    value = np.zeros(points.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, part, 1.0 - part), axis=-1)
        cell = (low + corner) % LATTICE.shape[0]
        value += weight * LATTICE[cell[..., 0], cell[..., 1], cell[..., 2]]
    return value


def texture(points):
    return 0.35 + 0.65 * sum(noise(points + 7.3, per_m) * share for per_m, share in ((5, 0.25), (17, 0.3), (45, 0.45)))


def plane(axis, place):
    def hit(origin, rays):
        with np.errstate(divide='ignore'):
            distance = (place - origin[axis]) / rays[..., axis]
        normal = np.zeros(rays.shape)
        normal[..., axis] = -np.sign(rays[..., axis])
        return distance, normal
    return hit


def box(low, high):
    low, high = np.array(low), np.array(high)

    def hit(origin, rays):
        with np.errstate(divide='ignore'):
            sides = np.stack([(low - origin) / rays, (high - origin) / rays])
        enter, leave = sides.min(axis=0), sides.max(axis=0)
        distance = enter.max(axis=-1)
        normal = np.where(enter == distance[..., None], -np.sign(rays), 0.0)
        return np.where(distance <= leave.min(axis=-1), distance, np.inf), normal
    return hit


def round_thing(centre, radius, axes):
    """A ball, or with two axes an upright column."""
    axes = list(axes)
    centre = np.array(centre)

    def hit(origin, rays):
        from_centre = (origin - centre)[axes]
        direction = rays[..., axes]
        a = (direction * direction).sum(axis=-1)
        b = (direction * from_centre).sum(axis=-1)
        inside = b * b - a * ((from_centre * from_centre).sum() - radius * radius)
        distance = np.where(inside > 0, (-b - np.sqrt(np.maximum(inside, 0.0))) / a, np.inf)
        normal = np.zeros(rays.shape)
        with np.errstate(invalid='ignore'):
            normal[..., axes] = (from_centre + distance[..., None] * direction) / radius
        return distance, np.nan_to_num(normal)
    return hit


# Each with its colour: red, green, blue.
SCENE = [
    (plane(2, 0.0), (200, 190, 175)),                                    # floor
    (plane(0, 4.0), (215, 205, 190)),                                    # wall
    (box((1.8, 0.5, 0.0), (2.2, 0.9, 0.4)), (225, 70, 55)),              # crates
    (box((2.35, -0.6, 0.0), (2.65, -0.3, 0.55)), (70, 180, 75)),
    (round_thing((3.0, 0.15, 0.0), 0.12, (0, 1)), (70, 110, 225)),       # column
    (round_thing((1.55, 0.1, 0.15), 0.15, (0, 1, 2)), (235, 200, 60)),   # ball
]
LIGHT = np.array([-0.45, 0.3, 0.84])


def render(robot, row, column):
    across, down = robot.steps(row, column)
    rotation = robot.rotation()
    origin = robot.at_m + rotation @ np.array([across * robot.spacing_m, down * robot.spacing_m, 0.0])
    offsets = (np.arange(SAMPLES) + 0.5) / SAMPLES - 0.5
    xs = (np.arange(robot.width)[:, None] + offsets).ravel() - robot.centre_px[0]
    ys = (np.arange(robot.height)[:, None] + offsets).ravel() - robot.centre_px[1]
    in_camera = np.stack(np.broadcast_arrays(xs[None, :] / robot.focal_px, ys[:, None] / robot.focal_px, 1.0), axis=-1)
    rays = in_camera @ rotation.T
    nearest = np.full(rays.shape[:2], FARTHEST_M)
    image = np.zeros(rays.shape)
    for hit, colour in SCENE:
        distance, normal = hit(origin, rays)
        seen = (distance > NEAREST_M) & (distance < nearest)
        nearest = np.where(seen, distance, nearest)
        points = origin + distance[seen][:, None] * rays[seen]
        shade = 0.55 + 0.45 * np.maximum(normal[seen] @ LIGHT, 0.0)
        image[seen] = np.array(colour) * (shade * texture(points))[:, None]
    small = image.reshape(robot.height, SAMPLES, robot.width, SAMPLES, 3).mean(axis=(1, 3))
    # Each camera has noise of its own.
    small += np.random.default_rng(100 * row + column).normal(0.0, 1.0, small.shape)
    return np.clip(np.round(small), 0, 255).astype(np.uint8)


# --------------------------------------------------------------------- files --

def write(text, *path):
    with open(os.path.join(TOP, *path), 'w', encoding='utf-8') as file:
        file.write(text)


def triple(values):
    return ' '.join(f'{value + 0.0:.6g}' for value in values)


def box_link(name, size, colour):
    return f'''  <link name="{name}">
    <visual>
      <geometry><box size="{triple(size)}"/></geometry>
      <material name="{colour}"/>
    </visual>
  </link>
'''


def joint(parent, child, place, turned=(0.0, 0.0, 0.0)):
    return f'''  <joint name="{child}_joint" type="fixed">
    <parent link="{parent}"/>
    <child link="{child}"/>
    <origin xyz="{triple(place)}" rpy="{triple(turned)}"/>
  </joint>
'''


def urdf(robot):
    text = f'''<?xml version="1.0"?>
<!-- Written by data/make_robots.py: an array of {robot.rows} x {robot.columns} cameras on a robot. -->
<robot name="{robot.name}">
  <material name="body"><color rgba="0.85 0.55 0.2 1"/></material>
  <material name="array"><color rgba="0.2 0.2 0.22 1"/></material>
  <material name="lens"><color rgba="0.3 0.6 0.9 1"/></material>

  <!-- On the floor below the robot's middle; x forward, z up. -->
  <link name="base_link"/>
'''
    for name, size, place in robot.body:
        text += box_link(name, size, 'body') + joint('base_link', name, place)
    width, height = robot.columns * robot.spacing_m, robot.rows * robot.spacing_m
    text += '\n  <!-- The array: the reference camera is in its middle. -->\n'
    text += '  <link name="array"/>\n' + joint('base_link', 'array', robot.at_m, (0.0, robot.pitch, robot.yaw))
    text += box_link('array_plate', (0.02, width, height), 'array') + joint('array', 'array_plate', (-0.02, 0.0, 0.0))
    for row, column in robot.views():
        across, down = robot.steps(row, column)
        view = f'view_{row}_{column}'
        text += '\n' + box_link(view, (0.02, 0.012, 0.012), 'lens')
        text += joint('array', view, (0.0, -across * robot.spacing_m, -down * robot.spacing_m))
        text += f'  <link name="{view}_optical_frame"/>\n'
        text += joint(view, view + '_optical_frame', (0.0, 0.0, 0.0), (-math.pi / 2, 0.0, -math.pi / 2))
    return text + '</robot>\n'


def calibration(robot, row, column):
    across, down = robot.steps(row, column)
    f, (x, y) = robot.focal_px, robot.centre_px
    return f'''image_width: {robot.width}
image_height: {robot.height}
camera_name: view_{row}_{column}
camera_matrix:
  rows: 3
  cols: 3
  data: [{f}, 0, {x}, 0, {f}, {y}, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0, 0, 0, 0, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
# The camera stands at (-P[3] / P[0], -P[7] / P[5]) metres from the reference.
projection_matrix:
  rows: 3
  cols: 4
  data: [{f}, 0, {x}, {-f * across * robot.spacing_m + 0.0:.6g}, 0, {f}, {y}, {-f * down * robot.spacing_m + 0.0:.6g}, 0, 0, 1, 0]
'''


def array(robot):
    return f'''# The cameras of robot.urdf; clouds come in the robot's frame. Written by data/make_robots.py.
target_frame: base_link
array:
  rows: {robot.rows}
  columns: {robot.columns}
  image_topic: view_{{row}}_{{column}}/image_rect_color
  camera_info_url: package://light_field_depth/config/robots/{robot.name}/view_{{row}}_{{column}}.yaml
'''


def description(robot):
    return f'''# What the cameras of config/robots/{robot.name} see. Written by make_robots.py.
pattern: "view_{{row}}_{{column}}.jpg"
grid: {{rows: {robot.rows}, columns: {robot.columns}}}
focal_length_px: {robot.focal_px}
principal_point_px: [{robot.centre_px[0]}, {robot.centre_px[1]}]
baseline_m: [{robot.spacing_m}, {robot.spacing_m}]   # between adjacent columns, rows
'''


def main():
    for robot in ROBOTS:
        config, data = os.path.join('config', 'robots', robot.name), os.path.join('data', 'robots', robot.name)
        for folder in (config, data):
            os.makedirs(os.path.join(TOP, folder), exist_ok=True)
        write(urdf(robot), config, 'robot.urdf')
        write(array(robot), config, 'array.yaml')
        write(description(robot), data, 'light_field.yaml')
        for row, column in robot.views():
            write(calibration(robot, row, column), config, f'view_{row}_{column}.yaml')
            cv2.imwrite(os.path.join(TOP, data, f'view_{row}_{column}.jpg'), render(robot, row, column)[..., ::-1],
                        [cv2.IMWRITE_JPEG_QUALITY, 95])


main()
