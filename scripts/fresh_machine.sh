#!/usr/bin/env bash
# The two commands of the README on a machine where nothing is installed: makes a bare Debian 12 with debootstrap, clones
# the last commit into the home of a person who may use sudo, and runs ./run demo --headless and ./run test as that person.
#
# usage: fresh_machine.sh [FOLDER]
#
# FOLDER (a new temporary one by default) then holds the machine; it is removed at the end unless it was named. Needs root,
# debootstrap, about 10 GB and some 20 minutes on two cores; the network for Debian's packages alone, by way of this
# machine's mirror and proxy.
set -euo pipefail
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ "$(id -u)" -eq 0 ] || { echo "fresh_machine: run it as root; debootstrap and chroot need that." >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "fresh_machine: run apt-get install debootstrap first." >&2; exit 1; }
MACHINE=$(realpath -m "${1:-$(mktemp -d)}")
KEEP=$([ $# -gt 0 ] && echo true || echo false)
# This machine's own mirror. Either place may be missing, and a mirror need not be named there.
MIRROR=$({ grep -rhoE 'https?://[^ ]*debian\.org/debian/?|https?://[^ ]*/debian/?( |$)' /etc/apt/sources.list \
  /etc/apt/sources.list.d 2>/dev/null || true; } | sed '/snapshot/d; s/ //g; q')
MIRROR=${MIRROR:-http://deb.debian.org/debian}

say()
{
  echo "[fresh machine] $*" >&2
}

cleanup()
{
  trap - EXIT
  local folder
  for folder in dev/shm dev/pts dev sys proc; do
    mountpoint -q "$MACHINE/$folder" && umount -l "$MACHINE/$folder"
  done
  # What is mounted still must not be removed.
  if ! $KEEP && ! grep -q " $MACHINE/" /proc/mounts; then
    rm -rf --one-file-system "$MACHINE"
  fi
}
trap cleanup EXIT
trap 'exit 130' INT TERM

# inside COMMAND...: as root of the machine, with nothing of this one's environment but the proxy.
inside()
{
  chroot "$MACHINE" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"
}

say "a bare Debian 12 in $MACHINE from $MIRROR"
LOG=$(mktemp)
debootstrap --variant=minbase --include=ca-certificates,sudo bookworm "$MACHINE" "$MIRROR" >"$LOG" 2>&1 ||
  { tail -n 20 "$LOG" >&2; exit 1; }
rm -f "$LOG"
chmod 755 "$MACHINE"  # mktemp lets nobody else in
# Nobody minds if this machine does not outlive a power cut; syncing each file of a thousand packages takes longest.
echo force-unsafe-io >"$MACHINE/etc/dpkg/dpkg.cfg.d/unsafe-io"
printf 'deb %s bookworm main\ndeb %s bookworm-updates main\n' "$MIRROR" "$MIRROR" >"$MACHINE/etc/apt/sources.list"
grep -rhi 'proxy' /etc/apt/apt.conf /etc/apt/apt.conf.d 2>/dev/null >"$MACHINE/etc/apt/apt.conf.d/90proxy" || true
cp /etc/resolv.conf "$MACHINE/etc/resolv.conf"
printf '127.0.0.1 localhost %s\n' "$(hostname)" >"$MACHINE/etc/hosts"
mount -t proc proc "$MACHINE/proc"
mount -t sysfs -o ro sysfs "$MACHINE/sys"
mount -t tmpfs -o mode=755 tmpfs "$MACHINE/dev"
mkdir "$MACHINE/dev/pts" "$MACHINE/dev/shm"
mount -t devpts -o newinstance,ptmxmode=666 devpts "$MACHINE/dev/pts"
mount -t tmpfs tmpfs "$MACHINE/dev/shm"
for device in null:3 zero:5 full:7 random:8 urandom:9; do
  mknod -m 666 "$MACHINE/dev/${device%:*}" c 1 "${device#*:}"
done
mknod -m 666 "$MACHINE/dev/tty" c 5 0
ln -s pts/ptmx "$MACHINE/dev/ptmx"
ln -s /proc/self/fd "$MACHINE/dev/fd"

inside useradd --create-home --shell /bin/bash newcomer
echo 'newcomer ALL=(ALL) NOPASSWD: ALL' >"$MACHINE/etc/sudoers.d/newcomer"
mkdir "$MACHINE/home/newcomer/light_field_depth"
git -C "$TOP" archive HEAD | tar -x -C "$MACHINE/home/newcomer/light_field_depth"
inside chown -R newcomer: /home/newcomer
say "commit $(git -C "$TOP" rev-parse --short HEAD), $(inside dpkg-query -W | wc -l) packages installed"

status=0
for command in 'demo --headless' test; do
  say "./run $command"
  start=$SECONDS
  if inside sudo -u newcomer -i bash -c "cd light_field_depth && ./run $command"; then
    say "./run $command: done in $((SECONDS - start)) s"
  else
    say "./run $command: FAILED after $((SECONDS - start)) s"
    status=1
  fi
done
inside ls -l /home/newcomer/light_field_depth/demo_output >&2 || status=1
exit $status
