#!/usr/bin/env python3
"""Times this checkout against another commit: both programs take turns, so that a machine whose speed drifts does not
favour one of them.

usage: bench_against.py COMMIT [--rounds N] [--threads N] --input FOLDER...

The commit is built in a worktree of its own below build/against/, and must have `bench --presets`. A row gives the
medians over the rounds of the processor time, the median of their ratio taken round by round, and the accuracy of both.
Processor time, since it does not count what other programs of the machine take; with --wall it is the clock on the
wall, which is what counts for several threads on a quiet machine.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
BENCH = "devel/lib/light_field_depth/bench"


def build(commit):
    """The bench program of a commit."""
    name = subprocess.run(["git", "rev-parse", "--short", commit], cwd=TOP, check=True, text=True, stdout=subprocess.PIPE)
    tree = TOP / "build" / "against" / name.stdout.strip()
    if not tree.exists():
        subprocess.run(["git", "worktree", "add", "--quiet", "--force", "--detach", tree, commit], cwd=TOP, check=True)
    subprocess.run(["./run", "build"], cwd=tree, check=True, stdout=sys.stderr)
    return tree / BENCH


def measure(program, arguments):
    """{(scene, method): row} of one start of the program; the first frame of each row is not on the clock."""
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            [program, "--presets", "--runs", "1", "--threads", str(arguments.threads), "--results", folder, "--input"]
            + arguments.input,
            text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if run.returncode != 0:
            sys.exit(f"{program} failed: {run.stderr.strip()}")
        report = json.loads((pathlib.Path(folder) / "presets.json").read_text(encoding="utf-8"))
    return {(row["scene"], row["method"]): row for row in report["rows"]}


def accuracy(row):
    scores = row["accuracy"]
    return f"{scores['mse_100']:.3f} / {scores['badpix_007']:.2f} / {scores['badpix_003']:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commit")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--wall", action="store_true")
    parser.add_argument("--input", nargs="+", required=True)
    arguments = parser.parse_args()
    programs = {"before": build(arguments.commit), "now": TOP / BENCH}
    rounds = [{name: measure(program, arguments) for name, program in programs.items()}
              for _ in range(arguments.rounds)]
    field = "median_ms" if arguments.wall else "processor_median_ms"

    print(f"| scene | method | before ms | now ms | ratio | before: MSE x 100 / BadPix 0.07 / 0.03 | now |\n|{'---|' * 7}")
    ratios = {}
    for key in rounds[0]["now"]:
        times = {name: [r[name][key]["time"][field] for r in rounds] for name in programs}
        ratio = statistics.median(now / before for now, before in zip(times["now"], times["before"]))
        ratios.setdefault(key[1], []).append(ratio)
        print(f"| {key[0]} | {key[1]} | {statistics.median(times['before']):.1f} | {statistics.median(times['now']):.1f} "
              f"| {ratio:.3f} | {accuracy(rounds[0]['before'][key])} | {accuracy(rounds[0]['now'][key])} |")
    for method, values in ratios.items():
        print(f"| mean | {method} | | | {statistics.mean(values):.3f} | | |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
