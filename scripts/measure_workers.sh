#!/usr/bin/env bash
# Frames a second that distributed.launch gives with 1, 2 and 4 workers, and what goes over the wire. Each worker has one thread
# and a host of its own: a network namespace with an address on a bridge, where it sees the others over a virtual cable alone.
# The demo is played as fast as the most workers could use it. Prints a table, and leaves it in benchmark/results/workers.md.
# After ./run build, with source devel/setup.bash; needs iproute2, and root where users may make no namespaces.
#
# usage: measure_workers.sh [SECONDS [PRESET]]     of each measurement (20); of multiview (balanced)
set -euo pipefail
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
SECONDS_EACH=${1:-20}
PRESET=${2:-balanced}
RATE_HZ=12
MOST_WORKERS=4
NAME=measure_workers

# In a network of its own, which goes with it.
if [ -z "${OWN_NETWORK:-}" ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(--user --map-root-user)
  OWN_NETWORK=1 exec unshare "${as_root[@]}" --net "$0" "$@"
fi
. "$TOP/scripts/own_ros.sh"
LOGS=("$SCRATCH/launch.log")
PATH=$PATH:/usr/sbin:/sbin
export ROS_IP=10.77.0.1
export ROS_MASTER_URI=http://$ROS_IP:$PORT

# A host is a process that waits for the end of this script, in a network namespace of its own.
start_host()
{
  local number=$1 address=10.77.0.$((10 + $1)) host
  unshare --net tail --pid=$$ -f /dev/null &
  host=$!
  # The namespace is there when it is no longer this one.
  wait_until 10 bash -c "[ \"\$(readlink /proc/$host/ns/net)\" != \"\$(readlink /proc/self/ns/net)\" ]"
  ip link add "cable$number" type veth peer name eth0 netns "$host"
  ip link set "cable$number" master bridge up
  nsenter --target "$host" --net ip link set lo up
  nsenter --target "$host" --net ip address add "$address/24" dev eth0
  nsenter --target "$host" --net ip link set eth0 up
  printf '#!/bin/sh\nexec nsenter --target %s --net env ROS_IP=%s "$@"\n' "$host" "$address" >"$SCRATCH/on_host$number"
  chmod +x "$SCRATCH/on_host$number"
}

start_network()
{
  local number
  ip link set lo up
  ip link add bridge type bridge
  ip address add "$ROS_IP/24" dev bridge
  ip link set bridge up
  for ((number = 0; number < MOST_WORKERS; ++number)); do
    start_host "$number"
  done
}

# Bytes that went through all cables: to the workers, from them.
bytes_on_the_wire()
{
  ip -statistics -oneline link show type veth |
    awk '{ for (i = 1; i < NF; ++i) { if ($i == "RX:") from += $(i + 8); if ($i == "TX:") to += $(i + 8) } }
         END { printf "%.0f %.0f\n", to, from }'
}

# count_results SECONDS: of /light_field_depth/disparity, once some have come.
count_results()
{
  /usr/bin/python3 - "$1" <<'PYTHON'
import sys
import threading
import time

import rospy

SETTLED = 5
times = []
begun = threading.Event()


def take(_message):
    times.append(time.monotonic())
    if len(times) >= SETTLED:
        begun.set()


rospy.init_node('count_results', anonymous=True)
rospy.Subscriber('/light_field_depth/disparity', rospy.AnyMsg, take, queue_size=100, buff_size=1 << 24)
if not begun.wait(60.0):
    sys.exit('no results came within 60 s')
print('begun', flush=True)
first = len(times) - 1
time.sleep(float(sys.argv[1]))
last = len(times) - 1
print(last - first, (last - first) / (times[last] - times[first]), flush=True)
PYTHON
}

# measure LABEL LAUNCH ARGUMENT...: one row of the table.
measure()
{
  local label=$1 launch counter before=() after=() frames rate
  shift
  roslaunch --port "$PORT" light_field_depth "$@" preset:="$PRESET" threads:=1 >"$SCRATCH/launch.log" 2>&1 &
  launch=$!
  PIDS+=("$launch")
  wait_until 60 master_answers || fail "The ROS master did not come up within 60 s."
  rosrun light_field_depth light_field_player --input "$TOP/data/demo" --rate "$RATE_HZ" --loop true \
    >"$SCRATCH/player.log" 2>&1 &
  PIDS+=("$!")
  local player=$!
  : >"$SCRATCH/count"
  count_results "$SECONDS_EACH" >"$SCRATCH/count" &
  counter=$!
  PIDS+=("$counter")
  wait_until 70 grep -q begun "$SCRATCH/count" || fail "No results came with $label."
  read -ra before < <(bytes_on_the_wire)
  wait "$counter" || fail "The results could not be counted."
  read -ra after < <(bytes_on_the_wire)
  read -r frames rate < <(tail -n 1 "$SCRATCH/count")
  kill -INT "$player" "$launch"
  wait "$player" "$launch" || true
  awk -v label="$label" -v frames="$frames" -v rate="$rate" -v to=$((after[0] - before[0])) -v from=$((after[1] - before[1])) \
    'BEGIN { printf "| %s | %.1f | %.2f | %.2f | %.0f |\n", label, rate, to / frames / 1e6, from / frames / 1e6, (to + from) * rate / frames / 1e6 }' |
    tee -a "$SCRATCH/table.md" >&2
}

start_network
cat >"$SCRATCH/table.md" <<TEXT
| | frames a second | to a worker, MB a frame | from it, MB a frame | on the wire, MB a second |
|---|---|---|---|---|
TEXT
measure "one node, no worker" depth.launch temporal:=false
for workers in 1 2 4; do
  measure "workers: $workers" distributed.launch workers:="$workers" launch_prefix:="$SCRATCH/on_host"
done
mv "$SCRATCH/table.md" "$TOP/benchmark/results/workers.md"
cat "$TOP/benchmark/results/workers.md"
