#!/usr/bin/env bash
# What the nodelet holds: the bundled light field, as a bag with 100 frames at a given rate, played to it once for each set
# of results that somebody may listen to. Called by ./run bench --node, which has built the package and sourced its setup
# file.
# The node runs as depth.launch starts it, so with the help of the last frame.
#   TOOLS   folder of the package's programs        RESULTS  folder for node.md and the JSON files
# Arguments: --rate HZ (10), --frames N (100), --temporal true|false (true), --set NAME=VALUE of the node's other parameters
# (any number).
set -euo pipefail

TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
RATE=10
FRAMES=100
TEMPORAL=true
SETTINGS=()
VOXEL_SIZE=0.0
while [ $# -gt 0 ]; do
  case "$1" in
    --rate) RATE=$2 ;;
    --frames) FRAMES=$2 ;;
    --temporal) TEMPORAL=$2 ;;
    --set) SETTINGS+=("$2") ;;
    *) echo "bench --node: there is no argument '$1'; --rate, --frames, --temporal and --set are there." >&2 && exit 2 ;;
  esac
  shift 2
done

NAME="bench --node"
. "$TOP/scripts/own_ros.sh"
LOGS=("$SCRATCH"/{node,play}.log)

# measure LABEL FILE PRODUCT...: one row of the table, of BAG, with LAUNCH_ARGUMENTS.
LAUNCH_ARGUMENTS=()
measure()
{
  local label=$1 file=$2
  shift 2
  local setting launch report
  for setting in "${SETTINGS[@]}"; do
    rosparam set "/light_field_depth/${setting%%=*}" "${setting#*=}"
  done
  roslaunch light_field_depth depth.launch voxel_size:="$VOXEL_SIZE" temporal:="$TEMPORAL" \
    "${LAUNCH_ARGUMENTS[@]}" >"$SCRATCH/node.log" 2>&1 &
  launch=$!
  PIDS+=("$launch")
  "$TOOLS/stats_report" --label "$label" --output "$RESULTS/$file.json" --products "$@" >>"$SCRATCH/table.md" &
  report=$!
  PIDS+=("$report")
  # The node subscribes to the images once somebody listens to its stats.
  timeout $((FRAMES / RATE + 60)) rosbag play --quiet --wait-for-subscribers "$BAG" \
    >"$SCRATCH/play.log" 2>&1 || fail "The bag could not be played."
  wait "$report" || fail "The node gave no stats."
  kill -INT "$launch"
  wait "$launch" || true
  tail -n 1 "$SCRATCH/table.md" >&2
}

# write_bag NAME OPTION...: of the demo, BAG from here on.
write_bag()
{
  BAG=$SCRATCH/$1
  shift
  "$TOOLS/dataset_to_bag" --input "$TOP/data/demo" --output "$BAG" --count "$FRAMES" --rate "$RATE" "$@" >&2
}

mkdir -p "$RESULTS"
say "writing a bag of $FRAMES frames at $RATE Hz"
write_bag light_field.bag
roscore -p "$PORT" >"$SCRATCH/master.log" 2>&1 &
PIDS+=($!)
wait_until 30 master_answers || { say "The ROS master did not come up within 30 s."; exit 1; }

cat >"$SCRATCH/table.md" <<TEXT
| listened to, besides the stats | sets | dropped | rate, Hz | latency, median ms | 99th percentile | longest | conversion, mean ms | pipeline, mean ms | publication, mean ms | dense clouds |
|---|---|---|---|---|---|---|---|---|---|---|
TEXT
measure "disparity" node_disparity disparity
measure "disparity, points2" node_points2 disparity points2
measure "disparity, points2, points_dense" node_points_dense disparity points2 points_dense
VOXEL_SIZE=0.01
measure "the same, voxels of 1 cm" node_voxels disparity points2 points_dense
LAUNCH_ARGUMENTS=(preset:=realtime)
measure "the same, realtime" node_voxels_realtime disparity points2 points_dense
VOXEL_SIZE=0.0
rm "$BAG"
write_bag compressed.bag --jpeg 90
LAUNCH_ARGUMENTS=(preset:=realtime image_transport:=compressed)
measure "disparity, of JPEGs, realtime" node_compressed disparity
mv "$SCRATCH/table.md" "$RESULTS/node.md"
cat "$RESULTS/node.md"
