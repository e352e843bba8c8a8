#!/usr/bin/env bash
# Records the cameras of array.launch into a bag, replays it through array.launch, and waits for a cloud of it in the robot's
# frame. After ./run build, with source devel/setup.bash.
#
# usage: record_and_replay.sh [ARRAY [BAG]]     an example of config/robots (grid_3x3); the bag is thrown away if not named
set -euo pipefail
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
ARRAY=${1:-grid_3x3}
NAME=record_and_replay
. "$TOP/scripts/own_ros.sh"
LOGS=("$SCRATCH/launch.log")
BAG=$(realpath "${2:-$SCRATCH/array.bag}")
PATIENCE_S=60

# start ARGUMENT...: array.launch, which is LAUNCH from here on.
start()
{
  roslaunch --port "$PORT" light_field_depth array.launch array:="$ARRAY" rviz:=false "$@" >"$SCRATCH/launch.log" 2>&1 &
  LAUNCH=$!
  PIDS+=("$LAUNCH")
}

wait_for_cloud()
{
  wait_until 30 master_answers || fail "The ROS master did not come up within 30 s."
  timeout "$PATIENCE_S" rostopic echo -n 1 --noarr /light_field_depth/points2 >"$SCRATCH/cloud" ||
    fail "No cloud came within $PATIENCE_S s."
  grep -q 'frame_id: "base_link"' "$SCRATCH/cloud" || fail "The cloud is not in the frame base_link."
}

start record:="$BAG"
wait_for_cloud
sleep 3
kill -INT "$LAUNCH"
wait "$LAUNCH" || true
[ -s "$BAG" ] || fail "Nothing was recorded."
rosbag info "$BAG" | grep -E '^(size|duration|messages)|/tf|view_' >&2

start source:=replay bag:="$BAG"
wait_for_cloud
say "$ARRAY: recorded, replayed, and a cloud of $(awk '/^(width|height):/ { n = n ? n * $2 : $2 } END { print n }' "$SCRATCH/cloud") points in base_link"
