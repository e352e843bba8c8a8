#!/usr/bin/env bash
# Load for minutes: nodelets with more to do than they can, in a manager with what brings their images.
# Called by ./run soak, which has built the tests and sourced the package's setup file.
#   TOOLS   folder of the package's programs        RESULTS  folder for the page of results, soak.md
# Arguments: [SECONDS] of the longest run (600); [TESTS] a pattern of GoogleTest for some of them.
set -euo pipefail

TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export LIGHT_FIELD_DEPTH_SOAK_SECONDS=${1:-600}
TESTS=${2:-*}
[[ "$LIGHT_FIELD_DEPTH_SOAK_SECONDS" =~ ^[1-9][0-9]*$ ]] || { echo "soak: give seconds, not '$1'." >&2 && exit 2; }

NAME=soak
. "$TOP/scripts/own_ros.sh"

roscore -p "$PORT" >"$SCRATCH/master.log" 2>&1 &
PIDS+=($!)
wait_until 30 master_answers || { say "The ROS master did not come up within 30 s."; exit 1; }

export LIGHT_FIELD_DEPTH_SOAK_PAGE=$SCRATCH/soak.md
cat >"$LIGHT_FIELD_DEPTH_SOAK_PAGE" <<TEXT
| load | seconds | sets a second | sets in = out + dropped | memory in the second and the last tenth of the time, MB | latency, median and longest, ms | longest computing of a set, ms | until the last set is done, s | latency of single sets, before and after, ms |
|---|---|---|---|---|---|---|---|---|
TEXT
say "the longest run takes $LIGHT_FIELD_DEPTH_SOAK_SECONDS s"
status=0
"$TOOLS/test_load" --gtest_filter="$TESTS" >"$SCRATCH/load.log" 2>&1 || status=$?
grep -E 'Failure|FAILED|PASSED|rror' -A 4 "$SCRATCH/load.log" >&2 || true
mkdir -p "$RESULTS"
# The table first, whichever test came first.
{ grep '^|' "$LIGHT_FIELD_DEPTH_SOAK_PAGE"; grep -v '^|' "$LIGHT_FIELD_DEPTH_SOAK_PAGE" || true; } >"$RESULTS/soak.md"
cat "$RESULTS/soak.md"
[ $status -eq 0 ] || say "FAILED: not all bounds of test/rostest/test_load.cpp are kept"
exit $status
