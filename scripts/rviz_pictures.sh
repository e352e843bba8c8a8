#!/usr/bin/env bash
# Pictures of RViz, as the launch files show it: the two robots of array.launch in their own frame, the demo's cross in the
# camera's upright one and in a namespace, and an array of another name without a robot. After ./run build, with source
# devel/setup.bash.
#
# usage: rviz_pictures.sh [FOLDER]     (rviz_pictures)
set -euo pipefail
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
FOLDER=${1:-rviz_pictures}
NAME=rviz_pictures
. "$TOP/scripts/own_ros.sh"
. "$TOP/scripts/virtual_display.sh"

# picture NAME LAUNCH ARGUMENT...
picture()
{
  local name=$1 launch
  shift
  roslaunch --port "$PORT" light_field_depth "$@" >"$SCRATCH/launch.log" 2>&1 &
  launch=$!
  PIDS+=("$launch")
  wait_until 90 take_picture "$FOLDER/$name.png" ||
    { tail -n 30 "$SCRATCH/launch.log" >&2; say "RViz did not draw the cloud of $name within 90 s."; exit 1; }
  # The picture may have come with the first points.
  sleep 2
  take_picture "$FOLDER/$name.png"
  kill -INT "$launch"
  wait "$launch" || true
  say "$FOLDER/$name.png"
}

mkdir -p "$FOLDER"
start_virtual_display
picture grid_3x3 array.launch array:=grid_3x3
picture row_1x5 array.launch array:=row_1x5
picture demo play.launch input:="$TOP/data/demo" temporal:=false
ROS_NAMESPACE=robot picture demo_in_namespace play.launch input:="$TOP/data/demo" temporal:=false
picture grid_3x3_upright play.launch input:="$TOP/data/robots/grid_3x3" array:=grid_3x3 name:=front rate:=5
