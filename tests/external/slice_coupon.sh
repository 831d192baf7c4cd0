#!/usr/bin/env bash
# slice_coupon.sh FOLDER WORK: PrusaSlicer slices each piece of a coupon with the settings beside it. Together the flexible pieces for
# fits take less than 15 minutes, and so does the rigid one; the three hinges take less than 30, and all flexible ones on a plate less than 40.
set -euo pipefail
folder=$1
work=$2/coupon
mkdir -p "$work"

seconds_of() {
    local gcode=$work/$1.gcode said of=(--load "$folder/$1.ini" "$folder/$1.stl")
    [ -f "$folder/$1.stl" ] || of=("$folder/$1.3mf")
    prusa-slicer --skirts 0 --export-gcode --output "$gcode" "${of[@]}" >"$work/$1.log" 2>&1
    said=$(sed -n 's/^; estimated printing time (normal mode) = //p' "$gcode")
    # As in "1h 2m 3s".
    said=$(sed -E 's/([0-9]+)h/\1*3600+/; s/([0-9]+)m/\1*60+/; s/([0-9]+)s/\1/; s/ //g; s/\+$//' <<<"$said")
    echo $((said))
}

# What, s, and s that are allowed.
judged() {
    if [ "$2" -gt 0 ] && [ "$2" -lt "$3" ]; then
        echo "ok coupon's $1: $2 s"
    else
        echo "FAILED coupon's $1: $2 s, $3 are allowed"
    fi
}

gauge=$(seconds_of gauge)
bar=$(seconds_of bar)
bosses=$(seconds_of bosses)
hinges=0
for piece in "$folder"/hinge-*.stl; do
    hinges=$((hinges + $(seconds_of "$(basename "$piece" .stl)")))
done
judged "flexible pieces" $((gauge + bar)) 900
judged "rigid piece" "$bosses" 900
judged "hinges" "$hinges" 1800
judged "flexible plate" "$(seconds_of plate_tpu)" 2400
