#!/usr/bin/env bash
# Compares what two builds of the program write, byte by byte: every preset, every command that writes files, every format
# of the check. For a change that must not change any output, or to list what it changes.
#
# usage: compare_outputs.sh OLD_PROGRAM NEW_PROGRAM FOLDER
set -euo pipefail
cd "$(dirname "$0")/../.."
old=$1 new=$2 folder=$3

# run PROGRAM FOLDER: everything it writes and prints.
run() {
    local program=$1 out=$2 frame name format code
    rm -rf "$out"
    mkdir -p "$out/printed"
    # save NAME ARGUMENT...: what a command prints, and its exit code.
    save() {
        local to=$out/printed/$1
        shift
        code=0
        "$program" "$@" >"$to" 2>"$to.stderr" || code=$?
        echo "exit code $code" >>"$to.stderr"
        sed -i "s|$out|OUT|g" "$to" "$to.stderr"
    }
    for frame in params/frames/*.toml; do
        name=$(basename "$frame" .toml)
        save "$name.build" build "$name" --step -o "$out"
        save "$name.fold" fold "$name" -o "$out"
        save "$name.stiffness" stiffness "$name" -o "$out"
        save "$name.drop-frame" drop "$name" --model frame -o "$out"
        save "$name.drop-paper" drop "$name" --model paper-corrected -o "$out"
        save "$name.check" check "$name"
        save "$name.check.json" check "$name" --json
        for format in junit sarif markdown github; do
            save "$name.check.$format" check "$name" --format "$format"
        done
        save "$name.bom" bom "$name"
        save "$name.explain" explain arm_rod "$name"
    done
    save drop drop --model paper --height 0.3,1.5,2.62 -o "$out"
    save coupon coupon -o "$out"
    save params params --markdown
    save params.json params --json
    save schema schema frame
}

run "$old" "$folder/old"
run "$new" "$folder/new"
if diff -rq "$folder/old" "$folder/new" >"$folder/differences.txt"; then
    echo "no file differs"
else
    cat "$folder/differences.txt"
    exit 1
fi
