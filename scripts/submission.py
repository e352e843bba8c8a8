#!/usr/bin/python3
"""A submission to the HCI 4D Light Field Benchmark.

usage: submission.py --tools DIR --input SCENE [SCENE ...] [--output FILE.zip] [-- ARGUMENTS OF estimate]

Solves each scene's folder and packs disp_maps/SCENE.pfm and runtimes/SCENE.txt (seconds of the method, without reading
and writing), as the benchmark's submission instructions ask for. The rules that are checked: a map is a PFM of one channel,
as large as the scene's views and finite everywhere; the views are 512 x 512, or a warning says so; scenes of the benchmark
that are missing are named. All scenes are solved with the same arguments, as the rules want.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import zipfile

import numpy as np

from result_files import read_pfm

SIDE_PX = 512
SCENES = ['backgammon', 'pyramids', 'dots', 'stripes', 'boxes', 'cotton', 'dino', 'sideboard', 'bedroom', 'bicycle', 'herbs',
          'origami']


def solve(tools, scene, arguments):
    """The bytes of the map, and the seconds of the method."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.path.join(tools, 'estimate'), '--input', scene, '--output', folder, '--format', 'pfm'] + arguments,
                       check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, 'report.json'), encoding='utf-8') as file:
            report = json.load(file)
        path = os.path.join(folder, 'disparity.pfm')
        values = read_pfm(path)
        unknown = int((~np.isfinite(values)).sum())
        if values.shape != (report['size']['height'], report['size']['width']) or unknown > 0:
            raise ValueError(f'The map of {scene} is {values.shape[1]} x {values.shape[0]} pixels and has {unknown} that are not '
                             'finite; the benchmark wants a disparity at every pixel of the view.')
        if values.shape != (SIDE_PX, SIDE_PX):
            print(f'submission: {scene} is {values.shape[1]} x {values.shape[0]} pixels, those of the benchmark are {SIDE_PX} x '
                  f'{SIDE_PX}.', file=sys.stderr)
        with open(path, 'rb') as file:
            return file.read(), report['timings_ms']['total'] / 1000.0


def main():
    parser = argparse.ArgumentParser(prog='./run submission')
    parser.add_argument('--tools', required=True, help=argparse.SUPPRESS)
    parser.add_argument('--input', nargs='+', required=True, help='folders of scenes, named as the benchmark names them')
    parser.add_argument('--output', default='submission.zip', help='the zip file (submission.zip)')
    own, rest = sys.argv[1:], []
    if '--' in own:
        at = own.index('--')
        own, rest = own[:at], own[at + 1:]
    arguments = parser.parse_args(own)
    names = [os.path.basename(os.path.normpath(scene)) for scene in arguments.input]
    if len(set(names)) != len(names):
        sys.exit('submission: two scenes have the same name; the benchmark tells them apart by it.')
    partial = arguments.output + '.partial'
    try:
        with zipfile.ZipFile(partial, 'w', zipfile.ZIP_DEFLATED) as archive:
            for scene, name in zip(arguments.input, names):
                values, seconds = solve(arguments.tools, scene, rest)
                archive.writestr(f'disp_maps/{name}.pfm', values)
                archive.writestr(f'runtimes/{name}.txt', f'{seconds:.6f}\n')
                print(f'{name}: {seconds:.2f} s', flush=True)
        os.replace(partial, arguments.output)
    except (subprocess.CalledProcessError, OSError, ValueError) as error:
        if os.path.exists(partial):
            os.remove(partial)
        # estimate has said itself what is wrong.
        sys.exit(1 if isinstance(error, subprocess.CalledProcessError) else f'submission: {error}')
    missing = [scene for scene in SCENES if scene not in names]
    print(f'Wrote {arguments.output} with {len(names)} scenes.' +
          (f' The benchmark takes twelve; missing: {", ".join(missing)}.' if missing else ''))


if __name__ == '__main__':
    main()
