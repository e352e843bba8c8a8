#!/usr/bin/python3
"""Fits the weights of the evidence against a disparity (src/core/multiview/maps/confidence_weights.h).

usage: fit_confidence.py RESULT:TRUTH.pfm[:NOISE] ... [--threshold 0.07] [--border 15]

RESULT is the folder of `estimate --save-intermediate`, NOISE the standard deviation of the views' noise in 8-bit
levels, as far as it is known. A logistic regression with weights that cannot be negative, of whether the error of a
pixel is above the threshold; every scene counts alike. Prints the fitted constants and, for those in the code and for the
fitted ones, the area between the order by confidence and the ideal one (AUSE). Needs python3-numpy.

A fit to one scene is no improvement on others: constants are changed only where the area falls on all scenes.
"""
import argparse
import re

import numpy as np

NAMES = ['BASE', 'EDGE_WEIGHT', 'NEAR_EDGE_WEIGHT', 'UNCERTAINTY_WEIGHT', 'DISAGREEMENT_WEIGHT', 'PULL_WEIGHT',
         'MOVE_WEIGHT', 'CHANGE_WEIGHT', 'RESIDUAL_WEIGHT']
IN_CODE = np.array([-6.9, 12.0, 4.0, 20.0, 25.0, 18.0, 27.0, 6.4, 0.1])


def read_pfm(path):
    data = open(path, 'rb').read()
    head = re.match(rb'Pf\s+(\d+)\s+(\d+)\s+(\S+)\s', data)
    width, height = int(head[1]), int(head[2])
    values = np.frombuffer(data, '<f4' if float(head[3]) < 0 else '>f4', width * height, head.end())
    return np.flipud(values.reshape(height, width)).astype(np.float64)


def extent(values, radius):
    padded = np.pad(values, radius, mode='edge')
    windows = np.lib.stride_tricks.sliding_window_view(padded, (2 * radius + 1, 2 * radius + 1))
    return windows.max((2, 3)) - windows.min((2, 3))


def evidence(folder, noise):
    """Columns in the order of NAMES, with the limits that the code has."""
    disparity = read_pfm(f'{folder}/disparity.pfm')
    of = {name: read_pfm(f'{folder}/intermediate/multiview_{name}.pfm')
          for name in ('curvature', 'disagreement', 'target', 'searched', 'first_search', 'residual')}

    def ramp(value, start):
        return np.clip((value - start) / 0.3, 0, 1)
    columns = [np.ones_like(disparity), ramp(extent(disparity, 1), 0.05), ramp(extent(disparity, 2), 0.1),
               1 / np.sqrt(64 * of['curvature'] + 1), np.minimum(of['disagreement'], 0.3),
               np.minimum(abs(of['target'] - disparity), 0.15), np.minimum(abs(of['searched'] - disparity), 0.3),
               np.minimum(abs(of['first_search'] - of['searched']), 0.3),
               np.maximum(0, of['residual'] - 15 - 4 * noise)]
    return disparity, np.stack([np.nan_to_num(column) for column in columns], -1)


def fit(columns, wrong, weights_of_rows, rounds=60):
    scale = np.maximum(columns.std(0), 1e-9)
    scale[0] = 1
    x = columns / scale
    w = np.zeros(x.shape[1])
    active = np.ones(len(w), bool)
    for _ in range(rounds):
        p = 1 / (1 + np.exp(-np.clip(x @ w, -30, 30)))
        curvature = weights_of_rows * np.maximum(p * (1 - p), 1e-6)
        gradient = x.T @ (weights_of_rows * (wrong - p)) - 1e-6 * w
        active = (w > 0) | (gradient > 0)
        active[0] = True
        hessian = (x * curvature[:, None]).T @ x + 1e-6 * np.eye(len(w))
        step = np.zeros(len(w))
        step[active] = np.linalg.solve(hessian[np.ix_(active, active)], gradient[active])
        w = w + step
        w[1:] = np.maximum(w[1:], 0)
    return w / scale


def ause(against, wrong):
    """Mean, over the part of the pixels that is dropped, of the share of wrong ones among the rest above the least."""
    def shares(order):
        return np.cumsum(wrong[order]) / np.arange(1, len(wrong) + 1) / wrong.mean()
    return float(np.mean(shares(np.argsort(against, kind='stable')) - shares(np.argsort(wrong, kind='stable'))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('scenes', nargs='+', metavar='RESULT:TRUTH.pfm[:NOISE]')
    parser.add_argument('--threshold', type=float, default=0.07)
    parser.add_argument('--border', type=int, default=15)
    args = parser.parse_args()
    all_columns, all_wrong, all_weights = [], [], []
    for scene in args.scenes:
        parts = scene.split(':')
        disparity, columns = evidence(parts[0], float(parts[2]) if len(parts) > 2 else 0.0)
        inner = (slice(args.border, -args.border),) * 2
        error = abs(disparity - read_pfm(parts[1]))[inner]
        all_columns.append(columns[inner].reshape(-1, len(NAMES)))
        all_wrong.append((error > args.threshold).ravel().astype(float))
        all_weights.append(np.full(error.size, 1 / error.size))
    weights = fit(np.concatenate(all_columns), np.concatenate(all_wrong), np.concatenate(all_weights))
    for name, value in zip(NAMES, weights):
        print(f'constexpr float {name} = {value:.4g}F;')
    for scene, columns, wrong in zip(args.scenes, all_columns, all_wrong):
        print(f'{scene}: AUSE {ause(columns @ IN_CODE, wrong):.3f} with the constants of the code, '
              f'{ause(columns @ weights, wrong):.3f} with the fitted ones')


if __name__ == '__main__':
    main()
