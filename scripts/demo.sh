#!/usr/bin/env bash
# The main job on the bundled light field: bag -> rosbag play -> nodelet -> RViz. Called by ./run demo, which has built the
# package and sourced its setup file.
#   TOOLS   folder of the package's programs        OUTPUT  folder for the results
# --headless: RViz under Xvfb, a picture of it instead of a window, and an end.
set -euo pipefail

TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
HEADLESS=false
[ -n "${DISPLAY:-}" ] || HEADLESS=true
for argument in "$@"; do
  case "$argument" in
    --headless) HEADLESS=true ;;
    *) echo "demo: there is no argument '$argument'; --headless is the only one." >&2 && exit 2 ;;
  esac
done

NAME=demo
. "$TOP/scripts/own_ros.sh"
LOGS=("$SCRATCH/roslaunch.log")
. "$TOP/scripts/virtual_display.sh"

mkdir -p "$OUTPUT"
export ROSCONSOLE_STDOUT_LINE_BUFFERED=1

say "writing the bag"
"$TOOLS/dataset_to_bag" --input "$TOP/data/demo" --output "$SCRATCH/demo.bag" --count 20 --rate 2

$HEADLESS && start_virtual_display

say "starting the nodelet and RViz"
roslaunch --port "$PORT" light_field_depth demo.launch bag:="$SCRATCH/demo.bag" >"$SCRATCH/roslaunch.log" 2>&1 &
LAUNCH=$!
PIDS+=("$LAUNCH")

launch_answers()
{
  kill -0 "$LAUNCH" 2>/dev/null || fail "roslaunch ended early."
  master_answers
}
wait_until 30 launch_answers || fail "The ROS master did not come up within 30 s."

"$TOOLS/demo_report" --truth "$TOP/data/demo/truth.pfm" --output "$OUTPUT" --timeout 90 &
REPORT=$!
PIDS+=("$REPORT")
while kill -0 "$REPORT" 2>/dev/null; do
  kill -0 "$LAUNCH" 2>/dev/null || fail "roslaunch ended early."
  sleep 0.5
done
wait "$REPORT" || fail "No result came."

if $HEADLESS; then
  say "taking the picture"
  wait_until 60 take_picture "$OUTPUT/rviz.png" || { say "RViz did not draw the cloud within 60 s."; exit 1; }
  say "$OUTPUT: rviz.png, disparity.png, cloud.ply"
else
  say "$OUTPUT: disparity.png, cloud.ply. Close RViz or press Ctrl-C to end."
  wait "$LAUNCH"
fi
