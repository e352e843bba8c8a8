# shellcheck shell=bash
# For scripts that run ROS programs beside whatever else runs on the machine: a master's address and folders of their own,
# and an end to everything that they have begun. Sourced; the script sets NAME, by which it speaks, before.
#   SCRATCH  folder that goes with the script       PORT  of the master, which the script starts
#   PIDS     add what runs in the background; it is ended with the script
#   LOGS     set to files whose ends fail() shows

PIDS=()
LOGS=()
cleanup()
{
  trap - EXIT
  local pid
  for pid in "${PIDS[@]}"; do
    kill -INT "$pid" 2>/dev/null || true
  done
  for pid in "${PIDS[@]}"; do
    timeout 15 tail --pid="$pid" -f /dev/null || kill -KILL "$pid" 2>/dev/null || true
  done
  rm -rf "$SCRATCH"
}
SCRATCH=$(mktemp -d)
trap cleanup EXIT
trap 'exit 130' INT TERM

export ROS_HOME=$SCRATCH/ros ROS_LOG_DIR=$SCRATCH/log
mkdir -p "$ROS_HOME" "$ROS_LOG_DIR"
PORT=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://localhost:$PORT

say()
{
  echo "[$NAME] $*" >&2
}

# fail SENTENCE: with what the programs said last.
fail()
{
  [ ${#LOGS[@]} -eq 0 ] || tail -n 30 "${LOGS[@]}" >&2 || true
  say "$1"
  exit 1
}

# wait_until SECONDS COMMAND...: polls; fails when the time is over.
wait_until()
{
  local deadline=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $deadline ] || return 1
    sleep 0.2
  done
}

master_answers()
{
  (exec 3<>"/dev/tcp/localhost/$PORT") 2>/dev/null
}
