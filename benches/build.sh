#!/usr/bin/env bash
# build.sh [RUNS]: the whole process of `flexframe build` against its peers, run in turn on the same state of the machine.
#
# flexframe with pictures, flexframe without, then CadQuery when CADQUERY names a Python that has it, then OpenSCAD when
# OPENSCAD=1 (minutes). Every run is printed, none left out: wall, user and system seconds, load average before it.
set -euo pipefail
cd "$(dirname "$0")/.."

runs=${1:-3}
binary=${CARGO_TARGET_DIR:-target}/release/flexframe
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%R %U %S'

cargo build --release --quiet

# measured NAME COMMAND...: one line for one run.
measured() {
    local name=$1 load seconds
    shift
    read -r load _ </proc/loadavg
    seconds=$({ time "$@" >/dev/null 2>&1; } 2>&1)
    # shellcheck disable=SC2086
    printf '%-34s %8.2f %8.2f %8.2f %6s\n' "$name" $seconds "$load"
}

printf '%-34s %8s %8s %8s %6s\n' "" "wall s" "user s" "system s" "load"
for ((run = 0; run < runs; run++)); do
    measured "flexframe build" "$binary" build -q -o "$work/all"
    measured "flexframe build --no-pictures" "$binary" build -q --no-pictures -o "$work/meshes"
    measured "the same with --step" "$binary" build -q --no-pictures --step -o "$work/step"
    measured "flexframe build --step" "$binary" build -q --step -o "$work/both"
    measured "without --step on one thread" env RAYON_NUM_THREADS=1 "$binary" build -q --no-pictures -o "$work/one"
    if [[ -n ${CADQUERY:-} ]]; then
        measured "CadQuery" "$CADQUERY" benches/peers/cadquery_frame.py "$work/cadquery"
    fi
    if [[ -n ${OPENSCAD:-} ]]; then
        measured "OpenSCAD" bash benches/peers/openscad_frame.sh "$work/openscad"
    fi
done
