#!/usr/bin/python3
"""The figures of a light field in one page: those of the paper, and what tells whether to trust the result.

usage: report.py --tools DIR --published FILE.json --input DIR [--truth FILE.pfm] [--output DIR] [--threads N]

Solves the light field with all methods and presets of this package and writes the figures as PNG files and index.html, which
holds them all and needs no other file. With a truth, maps and clouds are scored against it.
"""
import argparse
import json
import os
import re
import subprocess
import sys

import matplotlib.image
import numpy as np

import report_figures as draw
from report_page import Page
from result_files import read_pfm, read_ply

PAPER = ['--method', 'paper2017']
RUNS = {
    'quality': ['--preset', 'quality'],
    'balanced': ['--preset', 'balanced'],
    'realtime': ['--preset', 'realtime'],
    'fast': ['--preset', 'fast'],
    'paper2017': PAPER,
    'paper2017, as published': PAPER + ['--set', 'paper2017_parameters=published'],
    'paper2017, no feature flow': PAPER + ['--set', 'feature_flow=false'],
}
# Before the variational step.
START = PAPER + ['--set', 'variational=false']
INITIALISATIONS = {
    'CPM': START + ['--set', 'initializer=cpm', '--set', 'feature_flow=false'],
    'DIS': START + ['--set', 'initializer=dis', '--set', 'feature_flow=false'],
    'CPM + EpicFlow': START + ['--set', 'initializer=epicflow', '--set', 'feature_flow=false'],
    'DeepFlow': START + ['--set', 'initializer=deepflow', '--set', 'feature_flow=false'],
    'PCAFlow': START + ['--set', 'initializer=pcaflow', '--set', 'feature_flow=false'],
    'CPM + feature flow': START + ['--set', 'initializer=cpm'],
    'DIS + feature flow': START + ['--set', 'initializer=dis'],
}
ABLATION = {
    'balanced without visibility': ['--set', 'multiview_visibility_passes=0'],
    'balanced without fusion of the background': ['--set', 'multiview_background_fusion=false'],
    'balanced without boundary pixels': ['--set', 'multiview_boundary_pixels=false'],
    'balanced without refinement': ['--set', 'multiview_refinements=0'],
    'paper2017 without variational refinement': START,
}
BORDER_PX = 15  # as in the HCI benchmark
SAME_SURFACE = 0.02  # part of depth, as evaluate --cloud has it
LEVELS_PER_PX, FIRST_LEVEL_PX = 8192.0, -4.0  # of truths of 16 bits, as data/README.md says


class Runner:
    """Runs the package's tools, each run in a folder of its own."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.done = {}

    def tool(self, name, options):
        result = subprocess.run([os.path.join(self.arguments.tools, name)] + options, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, universal_newlines=True)
        if result.returncode != 0:
            raise RuntimeError(f'{name}: {result.stderr.strip()}')
        return result.stdout

    def score(self, disparity, confidence):
        options = ['--result', disparity, '--truth', self.arguments.truth, '--json']
        return json.loads(self.tool('evaluate', options + (['--confidence', confidence] if confidence else [])))

    def estimate(self, name, options):
        """Report, folder, disparity, seconds; 'figures' where there is a truth."""
        key = tuple(options)
        if key in self.done:
            return self.done[key]
        print(f'[report] {name}', file=sys.stderr, flush=True)
        folder = os.path.join(self.arguments.output, 'runs', re.sub(r'\W+', '_', name))
        self.tool('estimate', ['--input', self.arguments.input, '--output', folder, '--threads', self.arguments.threads] + options)
        with open(os.path.join(folder, 'report.json'), encoding='utf-8') as file:
            run = {'report': json.load(file), 'folder': folder}
        run['disparity'] = read_pfm(os.path.join(folder, 'disparity.pfm'))
        run['seconds'] = run['report']['timings_ms']['total'] / 1000.0
        if self.arguments.truth:
            run['figures'] = self.score(os.path.join(folder, 'disparity.pfm'), os.path.join(folder, 'confidence.pfm'))
        self.done[key] = run
        return run

    def views_and_baselines(self, bounds):
        """The views on the reference's row and column, and OpenCV's maps as runs."""
        folder = os.path.join(self.arguments.output, 'runs', 'report_data')
        self.tool('report_data', ['--input', self.arguments.input, '--output', folder, f'--range-min={bounds[0]}',
                                  f'--range-max={bounds[1]}'])
        with open(os.path.join(folder, 'report_data.json'), encoding='utf-8') as file:
            data = json.load(file)
        for view in data['views']:
            image = matplotlib.image.imread(os.path.join(folder, view['file']))
            view['image'] = (image if image.ndim == 3 else np.repeat(image[..., None], 3, 2))[..., :3].astype(np.float32)
        baselines = {}
        for name, result in data['opencv'].items():
            if 'file' in result:
                path = os.path.join(folder, result['file'])
                baselines[name] = {'disparity': read_pfm(path), 'seconds': result['ms'] / 1000.0}
                if self.arguments.truth:
                    baselines[name]['figures'] = self.score(path, None)
        return data, baselines


def epipolar_plane(data, disparity, along_rows):
    """One row of all views on the reference's row, or the same of columns, with the slopes at some of its pixels."""
    reference = data['views'][data['reference']]
    number, axis = ('row', 0) if along_rows else ('column', 1)
    views = sorted((view for view in data['views'] if view[number] == reference[number]), key=lambda view: view['steps'][axis])
    if len(views) < 3:
        return None
    values = disparity if along_rows else disparity.T
    quarter = len(values) // 4
    line = quarter + int(np.argmax(np.nanstd(values[quarter:-quarter], axis=1)))
    image = np.stack([view['image'][line] if along_rows else view['image'][:, line] for view in views])
    at = np.arange(len(views))
    lines = []
    for x in np.linspace(0.04, 0.96, 24) * values.shape[1]:
        slope = values[line, int(x)]
        lines.append((np.array([int(x) - view['steps'][axis] * slope + view['offset_px'][axis] for view in views]), at))
    return f'{"Row" if along_rows else "Column"} {line} of all views on the {number} of the reference; lines: estimated slopes', image, lines


def shifted(image, dx, dy):
    """image(x + dx, y + dy), between pixels by the four around; beyond the border its last pixel."""
    height, width = image.shape[:2]
    x = np.clip(np.arange(width) + dx, 0, width - 1)
    y = np.clip(np.arange(height) + dy, 0, height - 1)
    left, top = np.minimum(x.astype(int), width - 2), np.minimum(y.astype(int), height - 2)
    fx, fy = (x - left)[None, :, None], (y - top)[:, None, None]
    rows = image[:, left] * (1 - fx) + image[:, left + 1] * fx
    return rows[top] * (1 - fy) + rows[top + 1] * fy


def refocused(data, disparity):
    """All views on one another, so that what has the disparity is sharp."""
    total = sum(shifted(view['image'], view['offset_px'][0] - view['steps'][0] * disparity,
                        view['offset_px'][1] - view['steps'][1] * disparity) for view in data['views'])
    return np.clip(total / len(data['views']), 0, 1)


def focal_stack(data, disparity, bounds):
    """Focused at three depths, and at each pixel where the estimate says."""
    named = [(f'focused at {value:.2f} px', refocused(data, value)) for value in np.percentile(disparity, (5, 50, 95))]
    depths = np.linspace(bounds[0], bounds[1], 24)
    nearest = np.argmin(np.abs(disparity[..., None] - depths), axis=2)
    sharp = np.zeros_like(named[0][1])
    for i in np.unique(nearest):
        sharp[nearest == i] = refocused(data, depths[i])[nearest == i]
    return named + [('focused at the estimated depth', sharp)]


def view_truth(folder, name):
    path = os.path.join(folder, 'view_truths', 'truth_' + name)
    if os.path.exists(path + '.pfm'):
        return read_pfm(path + '.pfm')
    if os.path.exists(path + '.png'):
        return matplotlib.image.imread(path + '.png') * 65535.0 / LEVELS_PER_PX + FIRST_LEVEL_PX
    return None


def hidden_from_reference(view, truth, reference_truth, infinity_px):
    """Where a view truly sees what nearer surfaces hide from the reference, by 2 % of depth, or what its image does not reach."""
    height, width = truth.shape
    y, x = np.mgrid[0:height, 0:width]
    column = np.round(x + truth * view['steps'][0] - view['offset_px'][0]).astype(int)
    row = np.round(y + truth * view['steps'][1] - view['offset_px'][1]).astype(int)
    outside = (column < 0) | (row < 0) | (column >= width) | (row >= height)
    there = reference_truth[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    return outside | (there + infinity_px > (1 + SAME_SURFACE) * (truth + infinity_px))


def scores_of_views(run, folder, data, reference_truth):
    """Of each view with a truth: (row, column), and percentages and errors of its map by name."""
    calibration = run['report'].get('calibration')
    scores = {}
    for i, view in enumerate(data['views']):
        place = f'{view["row"]:02}_{view["column"]:02}'
        truth = reference_truth if i == data['reference'] else view_truth(folder, place)
        if truth is None:
            continue
        maps = os.path.join(run['folder'], 'view_maps')
        error = np.abs(read_pfm(os.path.join(maps, f'disparity_{place}.pfm')) - truth)
        kept = matplotlib.image.imread(os.path.join(maps, f'origin_{place}.png')) > 0
        inner = np.zeros(truth.shape, bool)
        inner[BORDER_PX:-BORDER_PX, BORDER_PX:-BORDER_PX] = True
        score = {'bad': 100.0 * (error > draw.BAD_PX)[inner].mean(), 'kept': 100.0 * kept[inner].mean(),
                 'mse_kept': 100.0 * (error[inner & kept] ** 2).mean()}
        if calibration and i != data['reference']:
            infinity_px = calibration['disparity_offset_px']
            hidden = hidden_from_reference(view, truth, reference_truth, infinity_px)
            score['hidden'] = 100.0 * hidden.mean()
            score['hidden_kept'] = 100.0 * kept[hidden].mean()
            score['hidden_wrong'] = 100.0 * (kept & (error > SAME_SURFACE * (truth + infinity_px)))[hidden].mean()
        scores[view['row'], view['column']] = score
    return scores


def show_view_scores(page, scores, shape):
    if len(scores) > 1:
        page.figure('error_over_grid', draw.error_over_grid({place: score['bad'] for place, score in scores.items()}, shape,
                                                            f'pixels off by more than {draw.BAD_PX} px, %'),
                    'The maps of all views that have a truth.')
    keys = {'kept': 'kept for the cloud, %', 'mse_kept': 'MSE x 100 of those', 'hidden': 'hidden from the reference, %',
            'hidden_kept': 'of these kept, %', 'hidden_wrong': 'of these kept and off by 2 % of depth, %'}
    page.table(['view'] + list(keys.values()),
               [[f'{row}, {column}'] + [f'{score[key]:.3f}' if key in score else '-' for key in keys]
                for (row, column), score in sorted(scores.items())])


def show_clouds(page, runner, dense):
    arguments = runner.arguments
    scores, clouds = {}, []
    for name, words in (('cloud.ply', 'one map'), ('dense_cloud.ply', 'extra dense')):
        path = os.path.join(dense['folder'], name)
        clouds.append((words,) + read_ply(path))
        if arguments.truth:
            try:
                scores[words] = json.loads(runner.tool('evaluate', ['--cloud', path, '--truth', arguments.input, '--json']))
            except RuntimeError as error:
                print(f'[report] {error}', file=sys.stderr)
    height, width = dense['disparity'].shape
    page.figure('clouds', draw.clouds(clouds, dense['report']['calibration']['focal_length_px'], (width, height)),
                'The cloud of the reference view and the extra dense one (figure 6 of the paper). Each point fills one pixel; '
                'white: no point.')
    if scores:
        keys = list(next(iter(scores.values())))
        page.table(['cloud'] + [key.replace('_', ' ') for key in keys],
                   [[name] + ['-' if score[key] is None else f'{score[key]:.10g}' if score[key] > 1000 else f'{score[key]:.2f}'
                              for key in keys] for name, score in scores.items()])
        page.text('Percentages. Accuracy: of the points within 0.25 and 1 % of depth of a true surface; completeness: of the true '
                  'surface with a point that near; hidden: of what other views see and the reference does not.')


def figures_table(page, runs):
    page.table(['', 'seconds', 'MSE x 100', 'BadPix 0.07 %', 'BadPix 0.03 %'],
               [[name, f'{run["seconds"]:.3f}'] + [f'{run["figures"][key]:.2f}' for key in ('mse_100', 'badpix_007', 'badpix_003')]
                if 'figures' in run else [name, f'{run["seconds"]:.3f}', '-', '-', '-'] for name, run in runs.items()])


def published_methods(path, scene):
    with open(path, encoding='utf-8') as file:
        return json.load(file)['scenes'].get(scene, [])


def make_page(runner):
    arguments = runner.arguments
    page = Page(arguments.output)
    scene = os.path.basename(os.path.normpath(arguments.input))
    runs = {name: runner.estimate(name, options) for name, options in RUNS.items()}
    first = runs['balanced']
    truth = read_pfm(arguments.truth) if arguments.truth else None
    known = truth if truth is not None else first['disparity']
    bounds = np.percentile(known[np.isfinite(known)], (0.5, 99.5))
    data, baselines = runner.views_and_baselines(first['report']['disparity_range'])
    report = first['report']
    page.text(f'{report["views_found"]} views of {report["size"]["width"]} x {report["size"]["height"]} pixels, '
              f'{report["views_used"]} of them used by balanced; {report["threads"]} threads. Disparities in pixels per step of the '
              'grid, nearer is larger.' + (' Errors leave out 15 pixels at the border.' if truth is not None else ''))

    page.heading('1. Initialisations')
    starts = {name: runner.estimate(name, options) for name, options in INITIALISATIONS.items()}
    starts.update(baselines)
    starts['multi-view search'] = runner.estimate('multi-view search', ['--set', 'multiview_refinements=0'])
    page.figure('initialisations', draw.maps(starts, truth, bounds),
                'What the methods start from (figure 3 of the paper): matches of neighbouring views spread to all pixels, without and '
                'with feature flow; OpenCV alone; the search of multiview before its refinement.')
    figures_table(page, starts)

    page.heading('2. Accuracy against run time')
    if truth is not None:
        published = published_methods(arguments.published, scene)
        page.figure('accuracy', draw.accuracy({**runs, **baselines}, published),
                    'Error against run time (figure 4 of the paper). Red: measured here, stars the method of 2017. '
                    + (f'Blue: other methods, on other machines, from {", ".join(sorted({m["source"] for m in published}))}.' if published
                       else f'There are no published figures of the scene "{scene}" in data/published_methods.json.'))
    figures_table(page, {**runs, **baselines})

    page.heading('3. Disparity maps')
    page.figure('maps', draw.maps(runs, truth, bounds), 'All presets and methods (figure 5 of the paper)'
                + (f'; errors from -{draw.BAD_PX} (red, too far) to {draw.BAD_PX} px (blue, too near).' if truth is not None else '.'))
    if truth is not None:
        page.figure('sparsification', draw.sparsification({name: runs[name] for name in ('balanced', 'paper2017')}),
                    'How the error of the rest falls as the least confident pixels are dropped.')

    page.heading('4. Clouds')
    dense = runner.estimate('balanced, dense', ['--dense', '--view-maps'])
    if dense['report'].get('calibration'):
        show_clouds(page, runner, dense)
    else:
        page.text('The light field has no calibration, so there are no clouds.')

    page.heading('5. What to look at')
    planes = [plane for plane in (epipolar_plane(data, first['disparity'], along_rows) for along_rows in (True, False)) if plane]
    if planes:
        page.figure('epipolar_planes', draw.epipolar_planes(planes),
                    'Epipolar plane images: a point of the scene is a line, whose slope is its disparity. The drawn lines follow the '
                    'texture where the estimate is right.')
    page.figure('focal_stack', draw.images(focal_stack(data, first['disparity'], bounds)),
                'The views laid on one another, focused at three disparities and, in the last picture, at each pixel\'s own: that is '
                'sharp everywhere where the estimate is right.')

    page.heading('6. Errors, times and the verdict')
    if truth is not None:
        shape = [max(view[number] for view in data['views']) + 1 for number in ('row', 'column')]
        show_view_scores(page, scores_of_views(dense, arguments.input, data, truth), shape)
    times = [(name, {stage: ms for stage, ms in run['report']['timings_ms'].items() if stage not in ('total', 'decode', 'write')})
             for name, run in (('balanced', first), ('paper2017', runs['paper2017']))]
    page.figure('stages', draw.stages(times), 'Where the time goes.')
    ablation = {'balanced': first}
    ablation.update({name: runner.estimate(name, options) for name, options in ABLATION.items()})
    ablation['paper2017'] = runs['paper2017']
    ablation['paper2017 without feature flow'] = runs['paper2017, no feature flow']
    figures_table(page, ablation)
    page.text('The verdict on the input:')
    findings = report['verdict']['findings']
    page.table(['severity', 'finding'], [[finding['severity'], finding['sentence']] for finding in findings] or [['-', 'nothing']])
    return page.write(f'Light field {scene}')


def main():
    parser = argparse.ArgumentParser(prog='./run report')
    parser.add_argument('--tools', required=True, help=argparse.SUPPRESS)
    parser.add_argument('--published', required=True, help=argparse.SUPPRESS)
    parser.add_argument('--input', required=True, help='folder of the light field')
    parser.add_argument('--truth', help='true disparity of the reference view (PFM)')
    parser.add_argument('--output', default='light_field_report', help='folder of the page (light_field_report)')
    parser.add_argument('--threads', default='0', help='of every method (0: one per processor)')
    arguments = parser.parse_args()
    for name in ('truth.pfm', 'gt_disp_lowres.pfm'):
        path = os.path.join(arguments.input, name)
        if not arguments.truth and os.path.exists(path):
            arguments.truth = path
    try:
        path = make_page(Runner(arguments))
    except (RuntimeError, OSError, ValueError) as error:
        sys.exit(f'report: {error}')
    print(f'Wrote {path}')


if __name__ == '__main__':
    main()
