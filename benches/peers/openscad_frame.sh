#!/usr/bin/env bash
# openscad_frame.sh OUT: every part, one OpenSCAD process each, as many at once as there are cores.
set -euo pipefail
out=${1:-out}
scad=$(dirname "$0")/openscad_frame.scad
mkdir -p "$out"
printf '%s\n' top_corner bottom_corner knee fork motor_mount hub_joint hub pi_carrier battery_bracket \
    battery_sleeve battery_lid camera_connector_left camera_connector_right |
    xargs -P "$(nproc)" -I{} openscad -q -o "$out/{}.stl" -D 'part="{}"' "$scad"
