#!/usr/bin/env bash
# Compares the maps of two builds byte for byte: every preset and paper2017, on the demo and what is found of the data.
#
# usage: compare_maps.sh ESTIMATE_A ESTIMATE_B [DATA_FOLDER]
#
# ESTIMATE_A and ESTIMATE_B are two `estimate` programs; DATA_FOLDER holds hci/, lytro/, stanford/ and array/. Exits 1 if
# a map differs.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# \?//p' "$0" >&2; exit 2; }
TOP=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
A=$1 B=$2 DATA=${3:-$TOP/../shared/data}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
inputs=("$TOP/data/demo")
for folder in hci/cotton hci/antinous lytro/2067 stanford/lego_knights array/dolls; do
  [ -d "$DATA/$folder" ] && inputs+=("$DATA/$folder")
done
different=0 compared=0
for input in "${inputs[@]}"; do
  for settings in method=multiview,multiview_preset={quality,balanced,realtime,fast} method=paper2017; do
    arguments=()
    IFS=, read -ra pairs <<<"$settings"
    for pair in "${pairs[@]}"; do arguments+=(--set "$pair"); done
    "$A" --input "$input" --output "$WORK/a" "${arguments[@]}" >/dev/null 2>&1
    "$B" --input "$input" --output "$WORK/b" "${arguments[@]}" >/dev/null 2>&1
    for map in disparity.pfm confidence.pfm; do
      compared=$((compared + 1))
      cmp -s "$WORK/a/$map" "$WORK/b/$map" || { echo "$(basename "$input") $settings: $map differs"; different=$((different + 1)); }
    done
  done
done
echo "$compared maps compared, $different differ"
[ "$different" -eq 0 ]
