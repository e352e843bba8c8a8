#!/usr/bin/env bash
# The core on a processor that is no x86: builds the libraries without ROS for aarch64 against Debian's packages of that
# architecture, runs the tests of the vector kernels under qemu-user, and compares the map of the demo that estimate writes
# there with the one that it writes here.
#
# usage: check_neon.sh TOOLS [FOLDER [TESTS]]
#
# TOOLS: the folder of this machine's programs (devel/lib/light_field_depth). FOLDER (a new temporary one by default, which is
# removed at the end) keeps the packages (1.3 GB) and the build, so that a second run is short. TESTS: a pattern of ctest
# ('kernels' by default). Needs mmdebstrap, g++-aarch64-linux-gnu and qemu-user (apt-get install), and the network for the packages.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,11s/^# \?//p' "$0" >&2; exit 2; }
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
NATIVE=$(realpath "$1")
FOLDER=$(realpath -m "${2:-$(mktemp -d)}")
TESTS=${3:-kernels}
[ $# -ge 2 ] || trap 'rm -rf --one-file-system "$FOLDER"' EXIT
SYSROOT=$FOLDER/sysroot
BUILD=$FOLDER/build
TRIPLE=aarch64-linux-gnu
PACKAGES=libopencv-dev,libeigen3-dev,libyaml-cpp-dev,libjpeg-dev,libhwy-dev,libgtest-dev,libboost-dev,libcli11-dev,nlohmann-json3-dev,libstdc++-12-dev

say()
{
  echo "[neon] $*" >&2
}

for program in mmdebstrap qemu-aarch64 $TRIPLE-g++; do
  command -v "$program" >/dev/null ||
    { say "there is no $program: apt-get install mmdebstrap g++-aarch64-linux-gnu qemu-user"; exit 1; }
done

if [ ! -d "$SYSROOT" ]; then
  say "packages of arm64 into $SYSROOT"
  mkdir -p "$FOLDER"
  # Unpacked, not set up: none of their programs has to run.
  mmdebstrap --variant=extract --architectures=arm64 --include="$PACKAGES" bookworm "$SYSROOT.part" http://deb.debian.org/debian \
    >"$FOLDER/packages.log" 2>&1 || { tail -n 20 "$FOLDER/packages.log" >&2; exit 1; }
  mv "$SYSROOT.part" "$SYSROOT"
fi

# What Debian's alternatives would choose when the packages are set up.
LIBRARIES=$SYSROOT/usr/lib/$TRIPLE
SEARCHED=$LIBRARIES:$LIBRARIES/blas:$LIBRARIES/lapack
EMULATOR=(qemu-aarch64 -L "$SYSROOT" -E "LD_LIBRARY_PATH=$SEARCHED")
mkdir -p "$FOLDER"
cat >"$FOLDER/toolchain.cmake" <<TEXT
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER $TRIPLE-gcc)
set(CMAKE_CXX_COMPILER $TRIPLE-g++)
set(CMAKE_SYSROOT "$SYSROOT")
set(CMAKE_LIBRARY_ARCHITECTURE $TRIPLE)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,$SEARCHED")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-Wl,-rpath-link,$SEARCHED")
set(CMAKE_CROSSCOMPILING_EMULATOR "$(IFS=';' && echo "${EMULATOR[*]}")")
TEXT
say "building in $BUILD"
[ -f "$BUILD/build.ninja" ] || cmake -S "$TOP" -B "$BUILD" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$FOLDER/toolchain.cmake" \
  -DCMAKE_BUILD_TYPE=Release -DLIGHT_FIELD_DEPTH_WITH_ROS=OFF -DLIGHT_FIELD_DEPTH_BENCHMARK=OFF -DBUILD_TESTING=ON \
  -DLIGHT_FIELD_DEPTH_WERROR=ON >"$FOLDER/configure.log" 2>&1 || { tail -n 30 "$FOLDER/configure.log" >&2; exit 1; }
mapfile -t targets < <(cd "$BUILD" && ctest -N -R "$TESTS" | sed -n 's/^ *Test *#[0-9]*: //p')
cmake --build "$BUILD" --target estimate "${targets[@]}" >"$FOLDER/build.log" 2>&1 ||
  { grep -E 'error|FAILED' -A 5 "$FOLDER/build.log" | head -n 40 >&2; exit 1; }

say "${#targets[@]} test programs under qemu"
status=0
(cd "$BUILD" && ctest --output-on-failure -R "$TESTS") || status=1

# Kernels agree to the bit; what OpenCV computes between them need not.
for preset in fast balanced quality; do
  "$NATIVE/estimate" --input "$TOP/data/demo" --preset "$preset" --output "$FOLDER/here_$preset" >/dev/null
  "${EMULATOR[@]}" "$BUILD/estimate" --input "$TOP/data/demo" --preset "$preset" --output "$FOLDER/there_$preset" >/dev/null
  /usr/bin/python3 - "$FOLDER/here_$preset/disparity.pfm" "$FOLDER/there_$preset/disparity.pfm" "$preset" <<'PYTHON' || status=1
import array
import sys

MOST_PX = 0.01

def read(path):
    with open(path, "rb") as file:
        for _ in range(3):
            file.readline()
        return array.array("f", file.read())

here, there = read(sys.argv[1]), read(sys.argv[2])
differences = [abs(a - b) for a, b in zip(here, there)]
other = sum(1 for a, b in zip(here, there) if a != b)
print(f"{sys.argv[3]}: {len(here)} disparities, {100 * other / len(here):.1f} % with other bits, the largest difference {max(differences):.2g} px")
sys.exit(len(here) != len(there) or max(differences) > MOST_PX)
PYTHON
done
exit $status
