#!/usr/bin/env bash
# slice.sh OUT WORK SHA256 FILE.stl: one line, whether PrusaSlicer turns the part into G-code as it lies,
# with a 0.4 mm nozzle, 0.3 mm layers and supports where it wants them.
set -uo pipefail
out=$1 work=$2 sha=$3 file=$4
name="PrusaSlicer ${file#"$out"/}"
gcode=$work/slices/$sha.gcode log=$work/slices/$sha.log

mkdir -p "$work/slices"
rm -f "$gcode"
timeout 900 prusa-slicer --export-gcode \
    --nozzle-diameter 0.4 --layer-height 0.3 --first-layer-height 0.3 --fill-density 20% \
    --support-material --support-material-auto --bed-shape 0x0,220x0,220x220,0x220 \
    --output "$gcode" "$file" >"$log" 2>&1
code=$?

layers=$(grep -c '^;LAYER_CHANGE' "$gcode" 2>/dev/null)
if [[ $code != 0 ]]; then
    echo "FAILED $name: exit code $code, $(tail -n 1 "$log")"
elif [[ ${layers:-0} == 0 ]]; then
    echo "FAILED $name: no layers in its G-code"
elif grep -qiE '\berror\b|needs? repair|not manifold|empty layer' "$log"; then
    echo "FAILED $name: $(grep -iE '\berror\b|needs? repair|not manifold|empty layer' "$log" | head -n 1)"
else
    echo "ok $name"
    rm -f "$gcode" "$log"
fi
