#!/usr/bin/env python3
"""Whether the tests notice: sows one fault after the other into a copy of the checkout and runs the test that should fail.

usage: mutation_check.py [--list] [NAME...]

--list only checks that each fault still fits the source, which takes no time. Without names all faults are sown; each costs a
compilation. Builds in build/mutants, which keeps what does not change. Exit code 1 if a fault is not caught or does not fit.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
COPY = TOP / "build" / "mutants"

# Name, file, what stands there, what is put there, the test that has to fail.
FAULTS = [
    ("grid_twice", "src/core/light_field/light_field.cpp", "views[i].grid == views[i - 1].grid", "false", "test_light_field"),
    ("depth_sign", "src/core/light_field/geometry.cpp", "disparity_px + calibration.disparity_offset_px",
     "disparity_px - calibration.disparity_offset_px", "test_geometry"),
    ("reach", "src/core/light_field/reach.cpp", "if (images > MOST_IMAGES_OF_MOTION)", "if (images < 0.0)", "test_reach"),
    ("padding", "src/core/light_field/view_set.h", "const double most = side_px + TAPS_PX;",
     "const double most = 1e9 + side_px + TAPS_PX;", "test_reach"),
    ("first_label", "src/core/multiview/search/label_space.cpp", "std::floor(range.min / labels.step_px)",
     "std::ceil(range.min / labels.step_px)", "test_label_space"),
    ("nearest_surface", "src/core/cloud/surface_warp.cpp", "return ahead > same ||",
     "return ahead < -same ||", "test_view_maps"),
    ("noise_trusted", "src/core/multiview/multiview_estimator.cpp", "if (estimate.range.min >= estimate.range.max)",
     "if (estimate.range.min > estimate.range.max)", "test_invariances"),
    ("least_confidence", "src/core/pipeline/pipeline.cpp", "trust < options.min_confidence",
     "trust > options.min_confidence", "test_pipeline"),
    ("unknown_is_known", "src/evaluation/scored_pixels.cpp", "scored.known += std::isfinite(value) ? 1 : 0;", "scored.known += 1;",
     "test_evaluation"),
    ("flat_truth", "src/evaluation/scored_pixels.cpp", "std::max(finiteSpan(truth(area)), LEAST_ERROR_OF_UNKNOWN_PX)",
     "finiteSpan(truth(area))", "test_tool_faults"),
    ("pfm_size", "src/io/pfm.cpp", "if (found != wanted)", "if (found < wanted)", "test_pfm"),
    ("pfm_order", "src/io/pfm.cpp", "header.big_endian = *scale > 0.0;", "header.big_endian = *scale < 0.0;", "test_pfm"),
    ("left_behind", "src/io/files.cpp", "unlink(path_.c_str());", "", "test_files"),
    ("old_results", "src/io/result_folder.cpp", "fs::remove_all(target_ / name, error);", "", "test_result_folder"),
    ("foreign_files", "src/io/result_folder.cpp", "fs::path(name).filename() == name", "true", "test_result_folder"),
    ("single_frame", "src/io/dataset.cpp", "options.frame && description.frames.empty()", "false", "test_bad_light_fields"),
    ("short_rows", "src/ros/image_conversion.cpp", "message.step < row_bytes", "false", "test_image_conversion"),
    ("red_is_blue", "src/ros/image_conversion.cpp", "{encodings::RGB8, CV_8UC3, cv::COLOR_RGB2BGR}",
     "{encodings::RGB8, CV_8UC3, NO_CONVERSION}", "test_image_conversion"),
    ("uncounted_drops", "src/ros/frame_queue.cpp", "++dropped_;", "", "test_frame_queue"),
    ("tolerance", "src/ros/view_synchronizer.h", "spreadWith(set, stamp_ns) <= options_.tolerance_ns",
     "spreadWith(set, stamp_ns) < options_.tolerance_ns", "test_view_synchronizer"),
]


def fits(fault):
    name, file, old, _, _ = fault
    path = TOP / file
    count = path.read_text().count(old) if path.exists() else 0
    if count != 1:
        print(f"{name}: '{old}' stands {count} times in {file}, not once")
    return count == 1


def copy_checkout():
    listing = subprocess.run(["git", "-C", TOP, "ls-files"], check=True, capture_output=True, text=True).stdout
    for name in listing.splitlines():
        source, target = TOP / name, COPY / "source" / name
        if target.exists() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)


def run_test(test):
    """What the test says: 'passes', 'fails', or 'does not build'."""
    build = COPY / "source" / "build"
    if not (build / "build.ninja").exists():
        subprocess.run(["cmake", "-S", COPY / "source", "-B", build, "-G", "Ninja", f"-DCATKIN_DEVEL_PREFIX={COPY}/devel"],
                       check=True, stdout=subprocess.DEVNULL)
    if subprocess.run(["ninja", "-C", build, test], stdout=subprocess.DEVNULL).returncode != 0:
        return "does not build"
    program = COPY / "devel" / "lib" / "light_field_depth" / test
    try:
        code = subprocess.run([program], cwd=COPY / "source", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              timeout=300).returncode
    except subprocess.TimeoutExpired:
        return "fails"
    return "passes" if code == 0 else "fails"


def caught(fault):
    name, file, old, new, test = fault
    path = COPY / "source" / file
    whole = path.read_text()
    path.write_text(whole.replace(old, new))
    try:
        said = run_test(test)
    finally:
        path.write_text(whole)
    print(f"{name}: {test} {said}", flush=True)
    return said == "fails"


def passes_as_it_is(test):
    """A test that fails without a fault would catch all of them."""
    said = run_test(test)
    if said != "passes":
        print(f"{test} {said} without a fault", flush=True)
    return said == "passes"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    if not all([fits(fault) for fault in FAULTS]):
        return 1
    if arguments.list:
        print(f"{len(FAULTS)} faults, each fits")
        return 0
    copy_checkout()
    chosen = [fault for fault in FAULTS if not arguments.names or fault[0] in arguments.names]
    if not all([passes_as_it_is(test) for test in sorted({fault[4] for fault in chosen})]):
        return 1
    count = sum([caught(fault) for fault in chosen])
    print(f"{count} of {len(chosen)} faults are caught")
    return 0 if count == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
