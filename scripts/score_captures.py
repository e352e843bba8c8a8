#!/usr/bin/python3
"""Accuracy of the default method on scenes with truth, clean, noisy and as cameras see, and how flat captures come out.

usage: score_captures.py SHARED [--estimate PROGRAM] [--only REGEX] [--set NAME=VALUE ...]

SHARED is a folder with data/ (hci, array, lytro) and tools/ (score_disparity.py, score_flatness.py, camera_model.py).
Renders the noisy scenes and the camera's into a temporary folder, runs the program on each light field without a
parameter, and prints MSE x 100, BadPix 0.07 and 0.03, or roughness (px) and the distance from a known plane. Needs
python3-numpy and python3-opencv.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CROSS = [f'{row * 9 + column:03d}' for row in range(9) for column in range(9) if row == 4 or column == 4]
WALL = '--coefficients=-0.0001531,-0.0000443,-3.292632'

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument('shared')
parser.add_argument('--estimate', default=os.path.join(TOP, 'devel/lib/light_field_depth/estimate'))
parser.add_argument('--only', default='.')
parser.add_argument('--set', action='append', default=[])
args = parser.parse_args()
data = os.path.join(args.shared, 'data')
tools = os.path.join(args.shared, 'tools')
work = tempfile.mkdtemp(prefix='score_captures.')


def tool(name, *arguments):
    done = subprocess.run(['/usr/bin/python3', os.path.join(tools, name), *arguments], check=True, capture_output=True,
                          text=True)
    return dict(re.findall(r'(\S+)\s+(-?[\d.]+)', done.stdout))


def rendered(scene, *model):
    """The cross of a scene of 9 x 9 views, seen by a camera or with noise."""
    source = os.path.join(data, 'hci', scene)
    folder = os.path.join(work, scene + '_'.join(model).replace('--', '_').replace(' ', ''))
    os.makedirs(folder)
    views = os.path.join(work, 'views')
    shutil.rmtree(views, ignore_errors=True)
    os.makedirs(views)
    for view in CROSS:
        shutil.copy(os.path.join(source, f'input_Cam{view}.png'), views)
    tool('camera_model.py', views, folder, '--reference', 'input_Cam040.png', *model)
    return folder


def map_of(folder, name):
    output = os.path.join(work, 'result_' + name)
    options = [word for setting in args.set for word in ('--set', setting)]
    subprocess.run([args.estimate, '--input', folder, '--output', output, *options], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return os.path.join(output, 'disparity.pfm')


def with_truth(name, folder, truth):
    score = tool('score_disparity.py', map_of(folder(), name), truth)
    print(f"{name:<18} {score['mse_100']} / {score['badpix_007']} / {score['badpix_003']}", flush=True)


def flatness(name, folder, image, *plane):
    score = tool('score_flatness.py', map_of(folder, name), image, *plane)
    text = f"roughness {score['roughness']}"
    if plane:
        text += (f", plane {score['plane_rms']} rms, {score['plane_above_0.3']} % above 0.3 px, "
                 f"{score['plane_above_1.0']} % above 1 px")
    print(f'{name:<18} {text}', flush=True)


rows = []
for scene in ('cotton', 'antinous'):
    truth = os.path.join(data, 'hci', scene, 'gt_disp_lowres.pfm')
    rows.append((scene, lambda n, s=scene, t=truth: with_truth(n, lambda: os.path.join(data, 'hci', s), t)))
    rows.append((scene + '_sigma5',
                 lambda n, s=scene, t=truth: with_truth(n, lambda: rendered(s, '--noise', '5', '--seed', '105'), t)))
    rows.append((scene + '_camera', lambda n, s=scene, t=truth: with_truth(n, lambda: rendered(s, '--seed', '7'), t)))
demo = os.path.join(TOP, 'data/demo')
rows.append(('demo', lambda n: with_truth(n, lambda: demo, os.path.join(demo, 'truth.pfm'))))
rows.append(('dolls', lambda n: flatness(n, os.path.join(data, 'array/dolls'), os.path.join(data, 'array/dolls/0202.png'),
                                         '--plane', os.path.join(data, 'array/dolls_wall.png'), WALL)))
for capture, image in (('general_11', 'view_03_03.png'), ('flowers', 'IMG_0001_045_05_05.png')):
    rows.append((capture, lambda n, c=capture, i=image: flatness(n, os.path.join(data, 'lytro', c),
                                                                 os.path.join(data, 'lytro', c, i))))
try:
    for label, run in rows:
        if re.search(args.only, label):
            run(label)
except subprocess.CalledProcessError as error:
    sys.exit(f'{error}\n{error.stderr or ""}')
finally:
    shutil.rmtree(work)
