#!/usr/bin/env bash
# What others build on this package:
#   1. the libraries without ROS, with Highway, CLI11 and nlohmann-json as the FetchContent way has them: configured, and
#      sources compiled that include them. With --all they are built to the end (without optimisation) and installed,
#      and the example is built and run against that install space outside the checkout: a second build of everything;
#   2. the example against catkin's install space;
#   3. a catkin workspace with a package that depends on this one.
# Each install space may hold the public headers and no others.
#
# usage: check_consumers.sh [--all] BUILD_FOLDER DEVEL_FOLDER    both of a build with ROS, as ./run build makes them
set -euo pipefail
ALL=false
[ "${1:-}" != --all ] || { ALL=true; shift; }
[ $# -eq 2 ] || { sed -n '2,11s/^# \?//p' "$0" >&2; exit 2; }
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD=$(realpath "$1") DEVEL=$(realpath "$2")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
# ROS's own Python must come first.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin
unset PYTHONPATH PYTHONHOME

say()
{
  echo "[consumers] $*" >&2
}

# quietly LOG COMMAND...: its output only where it fails.
quietly()
{
  local log=$WORK/$1.log
  shift
  "$@" >"$log" 2>&1 || { tail -n 40 "$log" >&2; say "failed: $*"; exit 1; }
}

# expect_public_headers PREFIX [FOLDER_LEFT_OUT]
expect_public_headers()
{
  local folder=include/light_field_depth
  diff <(cd "$TOP/$folder" && find . -type f ${2:+-not -path "./$2/*"} | sort) \
    <(cd "$1/$folder" && find . -type f -not -name LightFieldDepthStats.h -not -name LightFieldDepthConfig.h | sort) ||
    { say "$1 does not hold the public headers alone"; exit 1; }
}

# run_example PREFIX: builds the example outside the checkout, against an install space, and runs it.
run_example()
{
  local prefix=$1 name
  name=$(basename "$1")
  cp -r "$TOP/examples" "$WORK/example_$name"
  quietly "configure_example_$name" cmake -S "$WORK/example_$name" -B "$WORK/build_example_$name" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix"
  quietly "build_example_$name" cmake --build "$WORK/build_example_$name"
  "$WORK/build_example_$name/estimate_light_field" "$TOP/data/demo" "$WORK/$name.ply"
  [ -s "$WORK/$name.ply" ] || { say "the example wrote no cloud"; exit 1; }
}

say "sources of Highway, CLI11 and nlohmann-json"
if "$TOP/scripts/debian_sources.sh" "$WORK/sources" highway cli11 nlohmann-json3 >"$WORK/sources.log" 2>&1; then
  say "the libraries without ROS"
  quietly configure_library cmake -S "$TOP" -B "$WORK/build_library" -G Ninja -DLIGHT_FIELD_DEPTH_WITH_ROS=OFF \
    -DLIGHT_FIELD_DEPTH_BENCHMARK=OFF -DLIGHT_FIELD_DEPTH_WERROR=ON -DLIGHT_FIELD_DEPTH_FETCH=ON \
    -DFETCHCONTENT_FULLY_DISCONNECTED=ON -DFETCHCONTENT_SOURCE_DIR_HIGHWAY="$WORK/sources/highway" \
    -DFETCHCONTENT_SOURCE_DIR_CLI11="$WORK/sources/cli11" \
    -DFETCHCONTENT_SOURCE_DIR_NLOHMANN_JSON="$WORK/sources/nlohmann-json3" -DCMAKE_INSTALL_PREFIX="$WORK/library" \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
  if $ALL; then
    quietly build_library cmake --build "$WORK/build_library"
    quietly install_library cmake --install "$WORK/build_library"
    expect_public_headers "$WORK/library" ros
    run_example "$WORK/library"
  else
    # The first includes Highway, the second CLI11 and nlohmann-json.
    quietly build_library cmake --build "$WORK/build_library" --target \
      src/core/CMakeFiles/light_field_depth_core.dir/multiview/search/median_kernels.cpp.o \
      src/tools/CMakeFiles/evaluate.dir/evaluate.cpp.o
  fi
else
  # A mirror need not have source packages; what it lacks says nothing of this package.
  tail -n 3 "$WORK/sources.log" >&2
  say "no source packages here: NOT CHECKED are the libraries without ROS"
  ! $ALL || exit 1
fi

say "catkin's install space"
quietly install_catkin cmake --install "$BUILD" --prefix "$WORK/catkin"
expect_public_headers "$WORK/catkin"
run_example "$WORK/catkin"

say "a catkin workspace"
mkdir -p "$WORK/workspace/src"
cp -r "$TOP/test/consumer" "$WORK/workspace/src/light_field_depth_consumer"
set +u
# shellcheck disable=SC1091
. "$DEVEL/setup.bash"
set -u
quietly catkin_make catkin_make -C "$WORK/workspace" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  -DPython3_EXECUTABLE=/usr/bin/python3
"$WORK/workspace/devel/lib/light_field_depth_consumer/points_of_a_folder" "$TOP/data/demo"
say "all of them build, link and run"
