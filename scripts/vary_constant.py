#!/usr/bin/env python3
"""What a constant of the core is worth: builds `estimate` with other values of it, and scores the maps.

usage: vary_constant.py FILE NAME [--factors 0.5,2] [--set NAME=VALUE]... [FOLDER...]

FILE is a source or header below src/core that says `NAME = NUMBER`. The folders are data sets with truth
(truth.pfm or gt_disp_lowres.pfm); without any, the demo and, where they are, the HCI scenes
of ../shared/data/hci. Prints a row for the value as it is and for each factor: MSE x 100 / BadPix 0.07 in % for each
folder. Builds in a copy of the checkout, build/vary, so that a second run only compiles what changes.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
COPY = TOP / "build" / "vary"


def truth_of(folder):
    for name in ("truth.pfm", "gt_disp_lowres.pfm"):
        if (folder / name).exists():
            return folder / name
    sys.exit(f"{folder}: there is no truth (truth.pfm, gt_disp_lowres.pfm)")


def default_folders():
    scenes = sorted((TOP / ".." / "shared" / "data" / "hci").glob("*/gt_disp_lowres.pfm"))
    return [TOP / "data" / "demo"] + [scene.parent for scene in scenes]


def copy_checkout():
    """The tracked files, as they are now; what did not change keeps its time, and so its object."""
    listing = subprocess.run(["git", "-C", TOP, "ls-files"], check=True, capture_output=True, text=True).stdout
    for name in listing.splitlines():
        source, target = TOP / name, COPY / "source" / name
        if source.is_file() and not (target.exists() and target.read_bytes() == source.read_bytes()):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


def with_value(text, name, factor):
    """@return the text with the constant times the factor, and the new value"""
    pattern = re.compile(rf"(\b{name}\s*=\s*)(-?[\d.]+(?:e-?\d+)?)(F?)\b")
    found = pattern.search(text)
    if found is None:
        sys.exit(f"there is no '{name} = NUMBER'")
    is_whole = re.fullmatch(r"-?\d+", found.group(2)) is not None
    value = float(found.group(2)) * factor
    spelt = str(round(value)) if is_whole else repr(value)
    return text[: found.start()] + found.group(1) + spelt + found.group(3) + text[found.end() :], spelt


def build():
    binary = COPY / "build"
    if not (binary / "build.ninja").exists():
        subprocess.run(["cmake", "-S", COPY / "source", "-B", binary, "-G", "Ninja"], check=True, capture_output=True)
    subprocess.run(["cmake", "--build", binary, "--target", "estimate", "evaluate"], check=True, capture_output=True)
    return next(binary.glob("**/lib/light_field_depth"))


def score(tools, folder, settings):
    with tempfile.TemporaryDirectory() as output:
        arguments = [argument for setting in settings for argument in ("--set", setting)]
        subprocess.run([tools / "estimate", "--input", folder, "--output", output, *arguments], check=True, capture_output=True)
        text = subprocess.run(
            [tools / "evaluate", "--result", pathlib.Path(output) / "disparity.pfm", "--truth", truth_of(folder), "--json"],
            check=True, capture_output=True, text=True).stdout
        figures = json.loads(text)
        return f"{figures['mse_100']:.3f} / {figures['badpix_007']:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("file")
    parser.add_argument("name")
    parser.add_argument("folders", nargs="*", type=pathlib.Path)
    parser.add_argument("--factors", default="0.5,2")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    folders = arguments.folders or default_folders()
    copy_checkout()
    source = TOP / arguments.file
    target = COPY / "source" / arguments.file
    print("| " + arguments.name + " | " + " | ".join(folder.resolve().name for folder in folders) + " |")
    print("|---" * (len(folders) + 1) + "|")
    try:
        for factor in [1.0] + [float(text) for text in arguments.factors.split(",")]:
            text, value = with_value(source.read_text(), arguments.name, factor)
            target.write_text(text)
            tools = build()
            print("| " + value + " | " + " | ".join(score(tools, folder, arguments.set) for folder in folders) + " |", flush=True)
    finally:
        shutil.copy(source, target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
