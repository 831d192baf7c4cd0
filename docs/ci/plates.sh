#!/usr/bin/env bash
# plates.sh FOLDER: writes the print plates of every frame into FOLDER, below the frame's own path, with the settings to print them with.
# FLEXFRAME and FRAMES as in gate.sh. A frame that cannot be built is left out: the gate has said why. Exit code: 0, or 3 when the program cannot be
# started, or a plate not be written.
set -uo pipefail
if ! ((BASH_VERSINFO[0] * 100 + BASH_VERSINFO[1] >= 404)); then
    echo "${0##*/}: bash 4.4 or later is needed, this is $BASH_VERSION; macOS has 3.2, and a newer one by brew install bash" >&2
    exit 3
fi
shopt -s globstar nullglob dotglob
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
        # A folder for each: frames of other folders have other paths, also where a name has what stands for a slash elsewhere.
        name=${name#/}
        name=${name//..\//up/}
        # A file named ..toml or ...toml leaves a name that means another folder.
        case ${name##*/} in . | ..) name+=-frame ;; esac
        "$flexframe" build --no-pictures --quiet --output "$built/$name" -- "$frame"
        code=$?
        # Beyond 2 it is the machine: a full disk, or no program.
        ((code > 2)) && exit 3
        if ((code == 0)); then
            mkdir -p "$folder/$name" && cp "$built/$name"/*/plates/*.3mf "$built/$name"/*/print-settings.md "$folder/$name/" || exit 3
        else
            echo "plates.sh: no plates of $frame" >&2
        fi
    done
done
exit 0
