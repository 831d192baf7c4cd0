#!/usr/bin/env bash
# plates.sh FOLDER: writes the print plates of every frame into a folder of FOLDER, with the settings to print them with.
# FLEXFRAME and FRAMES as in gate.sh. A frame that cannot be built is left out: the gate has said why.
set -uo pipefail
shopt -s globstar nullglob dotglob || exit 3
folder=$1
flexframe=${FLEXFRAME:-flexframe}
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
read -rd '' -a patterns <<<"${FRAMES:-frames/*.toml}"

for pattern in "${patterns[@]}"; do
    # The name of an existing file may contain brackets; it is then not a pattern. A preset is no file.
    # shellcheck disable=SC2206
    if [[ -e $pattern ]]; then found=("$pattern"); else found=($pattern); fi
    ((${#found[@]})) || found=("$pattern")
    for frame in "${found[@]}"; do
        name=${frame%.toml}
        name=${name//\//-}
        if "$flexframe" build --no-pictures --quiet --output "$built/$name" -- "$frame"; then
            mkdir -p "$folder/$name"
            cp "$built/$name"/*/plates/*.3mf "$built/$name"/*/print-settings.md "$folder/$name/"
        else
            echo "plates.sh: no plates of $frame" >&2
        fi
    done
done
exit 0
