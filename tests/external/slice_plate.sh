#!/usr/bin/env bash
# slice_plate.sh FOLDER WORK: PrusaSlicer opens every plate of a built frame with settings that contradict the plate's own
# (15 % infill, 0.3 mm layers, four walls), and slices it: the plate's own have to win, so that the filament is that of solid
# parts within 3 %, and the objects are as many and as named as the manifest says.
set -euo pipefail
folder=$1
work=$2/plates
mkdir -p "$work"
frame=$(basename "$folder")

for plate in "$folder"/plates/*.3mf; do
    name=$frame/$(basename "$plate")
    gcode=$work/$frame-$(basename "$plate" .3mf).gcode
    log=$work/$frame-$(basename "$plate" .3mf).log
    # The flow that print-settings.md states for the spool of the plate's material.
    flow=$(awk -v title="## $(basename "$plate" | sed 's/_.*//')" -F'|' \
        'index($0, title) == 1 { mine = 1 } mine && /filament_max_volumetric_speed/ { print $3 + 0; exit }' "$folder/print-settings.md")
    if ! prusa-slicer --load tests/external/contrary.ini --filament-max-volumetric-speed "$flow" --export-gcode --output "$gcode" "$plate" >"$log" 2>&1; then
        echo "FAILED PrusaSlicer opens $name: $(tail -1 "$log")"
        continue
    fi
    python3 tests/external/plate_gcode.py "$folder/manifest.json" "$plate" "$gcode" | sed "s|^|$name |" |
        sed -E "s|^(\S+) FAILED: |FAILED sliced \1: |; s|^(\S+) ok|ok sliced \1:|"
done
