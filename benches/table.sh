#!/usr/bin/env bash
# table.sh [RUNS]: the table of docs/performance.md, measured again: whole processes in turn, then changes in memory.
#
# Cold runs keep nothing. "After a change" is a run behind one of a frame that differs in one number of one part. CadQuery runs where
# CADQUERY names a Python that has it. Every run is printed, none left out: wall, user and system seconds, load average before it.
set -euo pipefail
cd "$(dirname "$0")/.."

runs=${1:-3}
binary=$(realpath -m "${CARGO_TARGET_DIR:-target}/release/flexframe")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%R %U %S'

cargo build --release --quiet
date -u +%F
grep -m1 'model name' /proc/cpuinfo || true

# measured NAME COMMAND...: one line for one run. A violated limit is no failure, what did not run at all is one.
measured() {
    local name=$1 load seconds
    shift
    read -r load _ </proc/loadavg
    seconds=$({ time { "$@" >/dev/null 2>"$work/errors" || [[ $? == 1 ]]; }; } 2>&1) || { cat "$work/errors" >&2; return 1; }
    # shellcheck disable=SC2086
    printf '%-42s %8.2f %8.2f %8.2f %6s\n' "$name" $seconds "$load"
}

# changed NUMBER: a frame whose motor mount has another wall.
changed() {
    printf 'base = "cognifly"\n[motor_mount]\nmotor_skirt_wall_mm = %s\n' "$1" >"$work/changed.toml"
}

printf '%-42s %8s %8s %8s %6s\n' "" "wall s" "user s" "system s" "load"
for ((run = 0; run < runs; run++)); do
    export FLEXFRAME_CACHE=off
    measured "check, cold" "$binary" check -q
    measured "build, cold" "$binary" build -q -o "$work/out"
    measured "build --no-pictures, cold" "$binary" build -q --no-pictures -o "$work/out"
    measured "fold, cold" "$binary" fold -q -o "$work/out"
    if [[ -n ${CADQUERY:-} ]]; then
        measured "CadQuery" "$CADQUERY" benches/peers/cadquery_frame.py "$work/cadquery"
    fi
    export FLEXFRAME_CACHE=$work/cache
    rm -rf "$FLEXFRAME_CACHE"
    changed 1.6
    measured "check, nothing kept yet" "$binary" check -q "$work/changed.toml"
    changed 1.7
    measured "check after a change of one part" "$binary" check -q "$work/changed.toml"
    measured "check again" "$binary" check -q "$work/changed.toml"
    measured "build, parts and findings kept" "$binary" build -q -o "$work/out" "$work/changed.toml"
    changed 1.8
    measured "build after a change of one part" "$binary" build -q -o "$work/out" "$work/changed.toml"
    measured "fold, parts kept" "$binary" fold -q -o "$work/out" "$work/changed.toml"
    export FLEXFRAME_CACHE=off
    (cd "$work" && rm -f small.toml && measured "new, README's example" "$binary" new small --propeller propeller-65mm --motor motor-1103 --envelope 195x195x112)
    measured "solve, 40 frames" "$binary" solve --minimise mass --vary arm_rod=78..86,cage_rod=180..195 --frames 40
done
cargo bench --quiet --bench live
