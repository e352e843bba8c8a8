#!/usr/bin/env python3
"""Interrupts `estimate` again and again: its results must be those of one run, whole, with nothing beside them.

usage: interrupt_estimate.py ESTIMATE FOLDER FOLDER [--runs N] [--seed N]

Two light fields are solved in turn into one folder, each run ended by SIGINT, SIGTERM or SIGHUP at a random time (some come too late).
Exit code 1 if hidden files are left, a file of the report is missing, or results are not those of the run that said so.
"""
import argparse
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def run(estimate, folder, output, seconds=None, number=None):
    command = [estimate, "--input", folder, "--output", output, "--save-intermediate", "--preset", "quality"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if number is not None:
        try:
            process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
    return process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("estimate")
    parser.add_argument("folders", nargs=2)
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    random.seed(arguments.seed)
    codes, left, mixed = {}, 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        output = pathlib.Path(scratch) / "results"
        start = time.monotonic()
        if run(arguments.estimate, arguments.folders[0], output) != 0:
            sys.exit("estimate fails on its own")
        whole = time.monotonic() - start
        for i in range(arguments.runs):
            folder = arguments.folders[i % 2]
            code = run(arguments.estimate, folder, output, random.uniform(0.0, 1.1 * whole), random.choice(SIGNALS))
            codes[code] = codes.get(code, 0) + 1
            names = [path.name for path in [*output.parent.iterdir(), *output.iterdir()]]
            left += any(".partial" in name for name in names)
            report = json.loads((output / "report.json").read_text())
            missing = any(not (output / name).exists() for name in report["files"])
            mixed += missing or (code == 0 and report["input"] != folder)
    print(f"{arguments.runs} runs of {whole:.2f} s, exit codes {codes}: hidden files left by {left}, results incomplete or mixed in {mixed}")
    return 1 if left or mixed else 0


if __name__ == "__main__":
    sys.exit(main())
