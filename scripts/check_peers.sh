#!/usr/bin/env bash
# What stereo_image_proc, depth_image_proc, pcl_ros, image_view, topic_tools and rosbag make of the node's results, held
# against the node's own (test/peers). After ./run build, with source devel/setup.bash; needs those packages
# (Debian: apt-get install libstereo-image-proc-dev libdepth-image-proc-dev pcl-ros-tools ros-image-view topic-tools python3-rosbag).
#
# usage: check_peers.sh
set -euo pipefail
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
for package in light_field_depth stereo_image_proc depth_image_proc pcl_ros image_view topic_tools rosbag; do
  rospack find "$package" >/dev/null 2>&1 ||
    { echo "check_peers: the package '$package' is not there; see the head of this script." >&2; exit 2; }
done
NAME=check_peers
. "$TOP/scripts/own_ros.sh"

mkdir "$SCRATCH/files"
roslaunch -p "$PORT" "$TOP/test/peers/peers.launch" folder:="$SCRATCH/files" >"$SCRATCH/launch.log" 2>&1 &
PIDS+=($!)
wait_until 30 master_answers || { say "The ROS master did not come up within 30 s."; exit 1; }
/usr/bin/python3 "$TOP/test/peers/check_peers.py" "$SCRATCH/files" || { tail -n 20 "$SCRATCH/launch.log" >&2; exit 1; }
