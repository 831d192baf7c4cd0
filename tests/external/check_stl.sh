#!/usr/bin/env bash
# check_stl.sh OUT WORK SHA256 FILE.stl: one line, what admesh says of the mesh. admesh exits with 0 on bad
# meshes and can hang, so its text is read and its time is limited.
set -uo pipefail
out=$1 file=$4
name="admesh ${file#"$out"/}"

report=$(timeout 300 admesh "$file" 2>&1)
code=$?
if [[ $code == 124 ]]; then
    echo "FAILED $name: no answer in 60 s"
    exit 0
fi

# number LABEL: the first number after "LABEL :".
number() {
    sed -nE "s/^.*$1 *: *([0-9]+).*/\1/p" <<<"$report" | head -n 1
}

wrong=()
expect() {
    local found
    found=$(number "$1")
    [[ $found == "$2" ]] || wrong+=("$1 ${found:-missing}, expected $2")
}
expect "Total disconnected facets" 0
expect "Degenerate facets" 0
expect "Edges fixed" 0
expect "Facets reversed" 0
expect "Backwards edges" 0
expect "Number of parts" 1

if [[ ${#wrong[@]} == 0 ]]; then
    echo "ok $name"
else
    printf -v list '%s; ' "${wrong[@]}"
    echo "FAILED $name: ${list%; }"
fi
