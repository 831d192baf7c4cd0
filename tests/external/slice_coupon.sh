#!/usr/bin/env bash
# slice_coupon.sh FOLDER WORK: PrusaSlicer slices each piece of a coupon with the settings beside it. Together the flexible pieces take
# less than 15 minutes, and so does the rigid one.
set -euo pipefail
folder=$1
work=$2/coupon
mkdir -p "$work"

seconds_of() {
    local gcode=$work/$1.gcode said
    prusa-slicer --load "$folder/$1.ini" --skirts 0 --export-gcode --output "$gcode" "$folder/$1.stl" >"$work/$1.log" 2>&1
    said=$(sed -n 's/^; estimated printing time (normal mode) = //p' "$gcode")
    # As in "1h 2m 3s".
    said=$(sed -E 's/([0-9]+)h/\1*3600+/; s/([0-9]+)m/\1*60+/; s/([0-9]+)s/\1/; s/ //g; s/\+$//' <<<"$said")
    echo $((said))
}

judged() {
    if [ "$2" -gt 0 ] && [ "$2" -lt 900 ]; then
        echo "ok coupon's $1: $2 s"
    else
        echo "FAILED coupon's $1: $2 s, 900 are allowed"
    fi
}

gauge=$(seconds_of gauge)
bar=$(seconds_of bar)
bosses=$(seconds_of bosses)
judged "flexible pieces" $((gauge + bar))
judged "rigid piece" "$bosses"
