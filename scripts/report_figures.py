"""The figures of ./run report, drawn from maps, clouds, images and figures."""
import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

BAD_PX = 0.07  # as in the HCI benchmark
COLUMNS = 4
WIDTH_IN = 11.0
COLOUR_BAR_IN = 1.2
LABEL_POINTS = 7


def bare(axis):
    axis.set_xticks([])
    axis.set_yticks([])


def label(name, run):
    lines = [name]
    if run.get('seconds') is not None:
        lines.append(f'{run["seconds"]:.3g} s')
    if 'figures' in run:
        lines[-1] += f', MSE x 100 {run["figures"]["mse_100"]:.2f}, bad {run["figures"]["badpix_007"]:.1f} %'
    return '\n'.join(lines)


def maps(runs, truth, bounds):
    """Maps in rows of four; below each, where there is a truth, its error."""
    cells = [(label(name, run), run['disparity']) for name, run in runs.items()]
    if truth is not None:
        cells.append(('truth', truth))
    bands = math.ceil(len(cells) / COLUMNS)
    each = 1 if truth is None else 2
    height, width = cells[0][1].shape
    side = (WIDTH_IN - COLOUR_BAR_IN) / COLUMNS * height / width
    figure, axes = plt.subplots(bands * each, COLUMNS, figsize=(WIDTH_IN, bands * (each * side + 0.5)), squeeze=False,
                                constrained_layout=True)
    for axis in axes.flat:
        axis.axis('off')
    error = None
    for i, (words, values) in enumerate(cells):
        top = axes[i // COLUMNS * each][i % COLUMNS]
        shown = top.imshow(values, cmap='turbo', vmin=bounds[0], vmax=bounds[1])
        top.set_title(words, fontsize=7.5)
        if truth is not None and words != 'truth':
            error = axes[i // COLUMNS * each + 1][i % COLUMNS].imshow(values - truth, cmap='RdBu', vmin=-BAD_PX, vmax=BAD_PX)
    for band in range(bands):
        figure.colorbar(shown, ax=axes[band * each], label='disparity, px', shrink=0.85)
        if error is not None:
            figure.colorbar(error, ax=axes[band * each + 1], label='error, px', shrink=0.85)
    return figure


def name_points(axis, points):
    """Writes names beside points, towards the middle of the axis and none over another. @param points (name, x, y, colour)"""
    axis.figure.canvas.draw()
    pixels_per_point = axis.figure.dpi / 72.0
    middle = axis.transAxes.transform((0.5, 0.5))[0]
    placed = [(name, x, y, colour) + tuple(axis.transData.transform((x, y))) for name, x, y, colour in points]
    for on_left in (True, False):
        lowest = -np.inf
        for name, x, y, colour, at_x, at_y in sorted((p for p in placed if (p[4] < middle) == on_left), key=lambda p: p[5]):
            lowest = max(lowest + 1.35 * LABEL_POINTS * pixels_per_point, at_y)
            # Beyond the points that the name would cover.
            away = 1 if on_left else -1
            begin = at_x
            for other in sorted((p[4] for p in placed if abs(p[5] - lowest) < LABEL_POINTS * pixels_per_point),
                                key=lambda at: away * at):
                if 0 < away * (other - begin) < (len(name) * 0.6 * LABEL_POINTS + 14) * pixels_per_point:
                    begin = other
            axis.annotate(name, (x, y), xytext=((begin - at_x) / pixels_per_point + 7 * away, (lowest - at_y) / pixels_per_point),
                          textcoords='offset points', ha='left' if on_left else 'right', va='center', fontsize=LABEL_POINTS,
                          color=colour)


def accuracy(measured, published):
    """Error against run time. @param published list of {name, seconds, mse_100, badpix_007}, each may be missing"""
    figure, axes = plt.subplots(1, 2, figsize=(WIDTH_IN, 5.2), constrained_layout=True)
    for axis, key, words in zip(axes, ('mse_100', 'badpix_007'),
                                ('mean square error x 100', f'pixels off by more than {BAD_PX} px, %')):
        points = [(name, run['seconds'], run['figures'][key], 'tab:red') for name, run in measured.items()]
        points += [(method['name'], method['seconds'], method[key], 'tab:blue') for method in published if key in method]
        for name, x, y, colour in points:
            axis.plot(x, y, '*' if 'paper2017' in name else 'o', color=colour, markersize=8)
        axis.set_xscale('log')
        axis.set_yscale('log')
        for side in (axis.xaxis, axis.yaxis):
            side.set_major_locator(LogLocator(subs=(1, 2, 5)))
            side.set_major_formatter(FuncFormatter(lambda value, _: f'{value:g}'))
            side.set_minor_formatter(NullFormatter())
        axis.set_xlabel('run time, s')
        axis.set_ylabel(words)
        axis.margins(0.12, 0.12)
        axis.grid(True, alpha=0.3)
        name_points(axis, points)
    return figure


def sparsification(runs):
    figure, axis = plt.subplots(figsize=(7, 4), constrained_layout=True)
    for name, run in runs.items():
        curves = run['figures']['sparsification']
        dropped = 100.0 * np.arange(len(curves['badpix_007_curve'])) / len(curves['badpix_007_curve'])
        line, = axis.plot(dropped, curves['badpix_007_curve'], label=name)
        axis.plot(dropped, curves['badpix_007_ideal_curve'], ':', color=line.get_color(), label=name + ', by the true error')
    axis.set_xlabel('least confident pixels dropped, %')
    axis.set_ylabel(f'of the rest off by more than {BAD_PX} px, %')
    axis.set_ylim(bottom=0)
    axis.legend(fontsize=8)
    axis.grid(True, alpha=0.3)
    return figure


def seen_from(position, colour, focal_length_px, size, middle, turn_degrees):
    """Points as a camera sees them that went round what is `middle` metres away; each fills one pixel, white is nothing."""
    turn = np.radians(turn_degrees)
    behind = position[:, 2] - middle
    x = np.cos(turn) * position[:, 0] + np.sin(turn) * behind
    z = -np.sin(turn) * position[:, 0] + np.cos(turn) * behind + middle
    width, height = size
    z = np.maximum(z, 1e-6)
    u = np.round(focal_length_px * x / z + width / 2)
    v = np.round(focal_length_px * position[:, 1] / z + height / 2)
    seen = (z > 0.1 * middle) & (u >= 0) & (u < width) & (v >= 0) & (v < height)
    order = np.argsort(-z[seen], kind='stable')
    image = np.full((height, width, 3), 255, np.uint8)
    image[v[seen][order].astype(int), u[seen][order].astype(int)] = colour[seen][order]
    return image


def clouds(named, focal_length_px, size, turns=(-14, 14)):
    """@param named list of (words, positions, colours)"""
    middle = np.median(named[0][1][:, 2])
    figure, axes = plt.subplots(len(named), len(turns), figsize=(WIDTH_IN, len(named) * WIDTH_IN / 2 * size[1] / size[0] + 0.6),
                                squeeze=False, constrained_layout=True)
    for row, (words, position, colour) in zip(axes, named):
        for axis, turn in zip(row, turns):
            axis.imshow(seen_from(position, colour, focal_length_px, size, middle, turn))
            axis.set_title(f'{words}, {len(position):,} points, from {abs(turn)} degrees to the {"left" if turn < 0 else "right"}',
                           fontsize=9)
            bare(axis)
    return figure


def epipolar_planes(planes):
    """@param planes list of (words, image: views x pixels x 3, lines: list of (x, y) arrays)"""
    figure, axes = plt.subplots(len(planes), 1, figsize=(WIDTH_IN, 2.1 * len(planes)), squeeze=False, constrained_layout=True)
    for axis, (words, image, lines) in zip(axes[:, 0], planes):
        axis.imshow(image, aspect='auto', interpolation='nearest')
        for x, y in lines:
            axis.plot(x, y, color='cyan', linewidth=1)
        axis.set_xlim(-0.5, image.shape[1] - 0.5)
        axis.set_ylim(image.shape[0] - 0.5, -0.5)
        axis.set_title(words, fontsize=9)
        axis.set_xlabel('pixel', fontsize=8)
        axis.set_ylabel('view', fontsize=8)
        axis.tick_params(labelsize=7)
    return figure


def images(named, columns=COLUMNS):
    """@param named list of (words, image)"""
    height, width = named[0][1].shape[:2]
    rows = math.ceil(len(named) / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(WIDTH_IN, rows * (WIDTH_IN / columns * height / width + 0.3)),
                                squeeze=False, constrained_layout=True)
    for axis in axes.flat:
        axis.axis('off')
    for axis, (words, image) in zip(axes.flat, named):
        axis.imshow(image)
        axis.set_title(words, fontsize=8)
    return figure


def stages(named):
    """@param named list of (words, {stage: ms})"""
    heights = [len(times) for _, times in named]
    figure, axes = plt.subplots(1, len(named), figsize=(WIDTH_IN, 0.24 * max(heights) + 1), squeeze=False,
                                constrained_layout=True)
    for axis, (words, times) in zip(axes[0], named):
        names = sorted(times, key=times.get, reverse=True)
        axis.barh(names, [times[name] for name in names], color='tab:blue')
        axis.invert_yaxis()
        axis.set_xlabel('milliseconds')
        axis.set_title(words, fontsize=9)
        axis.tick_params(labelsize=8)
        axis.grid(True, axis='x', alpha=0.3)
    return figure


def error_over_grid(errors, shape, words):
    """@param errors {(row, column): value}"""
    grid = np.full(shape, np.nan)
    for place, value in errors.items():
        grid[place] = value
    figure, axis = plt.subplots(figsize=(5.5, 4.4), constrained_layout=True)
    shown = axis.imshow(grid, cmap='viridis')
    for (row, column), value in errors.items():
        axis.text(column, row, f'{value:.1f}', ha='center', va='center', fontsize=8, color='white',
                  bbox={'facecolor': 'black', 'alpha': 0.5, 'pad': 1, 'edgecolor': 'none'})
    axis.set_xticks(range(shape[1]))
    axis.set_yticks(range(shape[0]))
    axis.set_xlabel('column of the view')
    axis.set_ylabel('row of the view')
    figure.colorbar(shown, label=words)
    return figure
