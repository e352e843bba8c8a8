#!/usr/bin/env bash
# Fetches the sources of Debian packages with apt-get, whatever the machine's list of sources says about them.
#
# usage: debian_sources.sh FOLDER PACKAGE...
#
# Unpacks each into FOLDER/PACKAGE. The machine's own lists are left alone.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,6s/^# \?//p' "$0" >&2; exit 2; }
FOLDER=$(realpath -m "$1")
shift
APT=$(mktemp -d)
trap 'rm -rf "$APT"' EXIT
mkdir -p "$FOLDER" "$APT/lists/partial" "$APT/parts"
chmod 755 "$APT"

# The same servers and suites as for binaries.
{
  cat /etc/apt/sources.list 2>/dev/null || true
  # One-line entries of a deb822 file, without its options but the key.
  for file in /etc/apt/sources.list.d/*.sources; do
    [ -f "$file" ] || continue
    awk 'BEGIN { RS = ""; FS = "\n" } {
      uris = suites = components = key = ""
      for (i = 1; i <= NF; ++i) {
        if ($i ~ /^URIs:/) { uris = $i; sub(/^URIs: */, "", uris) }
        if ($i ~ /^Suites:/) { suites = $i; sub(/^Suites: */, "", suites) }
        if ($i ~ /^Components:/) { components = $i; sub(/^Components: */, "", components) }
        if ($i ~ /^Signed-By:/) { key = $i; sub(/^Signed-By: */, "", key) }
      }
      count = split(suites, suite, " ")
      for (i = 1; i <= count; ++i)
        print "deb " (key == "" ? "" : "[signed-by=" key "] ") uris " " suite[i] " " components
    }' "$file"
  done
} | grep -E '^deb .*(debian|ubuntu)' | sed 's/^deb /deb-src /' >"$APT/sources.list"

OPTIONS=(-o Dir::Etc::SourceList="$APT/sources.list" -o Dir::Etc::SourceParts="$APT/parts"
  -o Dir::State::Lists="$APT/lists" -o APT::Sandbox::User=root)
apt-get "${OPTIONS[@]}" -q update >&2
for package in "$@"; do
  rm -rf "${FOLDER:?}/$package"
  mkdir -p "$APT/$package"
  (cd "$APT/$package" && apt-get "${OPTIONS[@]}" -q source "$package" >&2)
  mv "$(find "$APT/$package" -mindepth 1 -maxdepth 1 -type d)" "$FOLDER/$package"
done
