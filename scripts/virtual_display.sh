# shellcheck shell=bash
# A display without a screen, for pictures of RViz. Sourced after own_ros.sh.

# start_virtual_display: sets DISPLAY.
start_virtual_display()
{
  local number_file=$SCRATCH/display
  Xvfb -displayfd 3 -screen 0 1600x900x24 +extension GLX 3>"$number_file" >/dev/null 2>&1 &
  PIDS+=($!)
  wait_until 20 test -s "$number_file" || { say "Xvfb did not start."; exit 1; }
  DISPLAY=:$(cat "$number_file")
  export DISPLAY LIBGL_ALWAYS_SOFTWARE=1
  export XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$SCRATCH/runtime}
  mkdir -p -m 700 "$XDG_RUNTIME_DIR"
}

# take_picture FILE: of the display. It is ready when RViz has drawn the cloud: many colours right of its panels.
take_picture()
{
  import -window root "$1" 2>/dev/null && [ "$(convert "$1" -crop 1180x760+390+80 -format %k info:)" -gt 4000 ]
}
