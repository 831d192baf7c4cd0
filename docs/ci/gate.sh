#!/usr/bin/env bash
# gate.sh: checks frames against their limits, as a job of a build server. It needs bash 4.4 or later. Variables configure it:
#
#   FLEXFRAME         the program; default "flexframe"
#   FRAMES            presets, files or patterns, separated by spaces; default "frames/*.toml"
#   FORMAT            github (annotations) or text
#   STRICT            true: a note whose value exceeds its limit fails
#   STRENGTH          true: the design drop by the frame's own mechanics is checked and compared, too; some seconds a frame
#   BASELINE          a list of accepted findings
#   BASE              a revision; each frame that exists there is compared with it. A frame that is refused there counts as new
#   FAIL_ON_INCREASE  largest allowed increases against BASE, such as mass=2g, separated by spaces
#   SUMMARY           a file to which the Markdown page is appended
#   JUNIT, SARIF      files for the reports; there is none if check ends without a report, as when no file matches
#
# Exit code: 0 all limits are kept, 1 a limit is violated or an increase is too large, 2 an input is wrong, 3 a disk or permission error, or no program.
set -uo pipefail
# The same patterns as in the program: ** is any number of folders, and names that begin with a dot are included.
if ! ((BASH_VERSINFO[0] * 100 + BASH_VERSINFO[1] >= 404)); then
    echo "${0##*/}: bash 4.4 or later is needed, this is $BASH_VERSION; macOS has 3.2, and a newer one by brew install bash" >&2
    exit 3
fi
shopt -s globstar nullglob dotglob
flexframe=${FLEXFRAME:-flexframe}
read -rd '' -a frames <<<"${FRAMES:-frames/*.toml}"
# An absolute pattern below this folder is that of the repository's files: git names them from here.
frames=("${frames[@]#"$PWD/"}")

options=()
[[ ${STRICT:-} == true ]] && options+=(--strict)
[[ ${STRENGTH:-} == true ]] && options+=(--strength)
[[ -n ${BASELINE:-} ]] && options+=(--baseline "$BASELINE")

check() { "$flexframe" check "${options[@]}" "$@" -- "${frames[@]}"; }

# The first call computes the findings and caches them; the others only convert them to another format.
check --format "${FORMAT:-text}"
code=$?
# The program could not be started: the machine is wrong, not a frame.
((code == 126 || code == 127)) && exit 3

# fails CODE: the job ends with the highest code.
fails() { (($1 > code)) && code=$1; }

# writes FILE: it can be written, at its end.
writes() {
    : >>"$1" && return
    echo "gate.sh: $1 cannot be written" >&2
    fails 3
    return 1
}

# report FORMAT FILE: an empty file would be read as a broken report, or as one without findings.
report() {
    writes "$2" || return
    check --format "$1" >"$2" 2>/dev/null
    (($? == 3)) && fails 3
    # A link, such as /dev/stdout, is not ours.
    [[ -f $2 && ! -L $2 && ! -s $2 ]] || return
    rm -f -- "$2"
    echo "gate.sh: $2 is not written, because check ended without a report" >&2
}
[[ -n ${JUNIT:-} ]] && report junit "$JUNIT"
[[ -n ${SARIF:-} ]] && report sarif "$SARIF"
if [[ -n ${SUMMARY:-} ]] && writes "$SUMMARY"; then
    check --format markdown >>"$SUMMARY" 2>/dev/null
    (($? == 3)) && fails 3
fi

# A frame also depends on its bases: it may change although its own file does not.
some_file_changed() {
    ! git diff --quiet "$BASE" -- ':/*.toml' || [[ -n $(git ls-files --others --exclude-standard -- ':/*.toml') ]]
}

# former_tree: the files of BASE in the folder $former. The bases of a frame are read there, too.
former=""
former_tree() {
    [[ -n $former ]] && return
    local folder
    folder=$(mktemp -d) || return
    trap 'git worktree remove --force "$former" 2>/dev/null; rm -rf -- "${former%/*}"' EXIT
    former=$folder/base
    git worktree add --quiet --detach "$former" "$BASE"
}

# was_refused FRAME: check refuses the frame as it is in BASE. If diff refuses the frame beside itself, the reason is another one:
# the frame as it is now, or the options.
was_refused() {
    local file
    "$flexframe" diff --quiet "${limits[@]}" -- "$1" "$1" >/dev/null 2>&1
    (($? < 2)) || return
    former_tree
    file=$former/$(git rev-parse --show-prefix)$1
    [[ -f $file ]] || return
    "$flexframe" check --quiet -- "$file" >/dev/null 2>&1
    (($? == 2))
}

# annotate KIND FILE TEXT: said without an effect on the exit code. KIND is notice or error.
annotate() {
    local kind=$1
    shift
    if [[ ${FORMAT:-text} != github ]]; then
        echo "gate.sh: $1: $2" >&2
        return
    fi
    # The name of a file may contain what ends a property, or the command.
    local file=${1//%/%25}
    file=${file//$'\r'/%0D} file=${file//$'\n'/%0A} file=${file//:/%3A}
    local text=${2//%/%25}
    text=${text//$'\r'/%0D} text=${text//$'\n'/%0A}
    echo "::$kind file=${file//,/%2C},title=flexframe::$text"
}

compare() {
    local page grown said
    # A new file has no earlier revision.
    [[ $1 == *.toml && -f $1 ]] && git cat-file -e "$BASE:./$1" 2>/dev/null || return
    said=$(mktemp) || return
    page=$("$flexframe" diff --git "$BASE" --format markdown "${limits[@]}" -- "$1" 2>"$said")
    grown=$?
    cat -- "$said" >&2
    # What grew too much fails the job, so it is told beside the file, too.
    [[ $grown == 1 && ${FORMAT:-text} == github ]] && annotate error "$1" "$(<"$said")"
    rm -f -- "$said"
    if ((grown == 2)) && was_refused "$1"; then
        annotate notice "$1" "check refuses the frame as it is in the revision to compare with (the log has the reason), so it counts as new"
        return
    fi
    fails "$grown"
    # A frame without differences is not reported.
    [[ -z $page || $page == *$'\nNo difference.'* ]] && return
    if [[ -z ${SUMMARY:-} ]]; then
        printf '%s\n' "$page"
    elif writes "$SUMMARY"; then
        printf '%s\n' "$page" >>"$SUMMARY"
    fi
}

if [[ -n ${BASE:-} ]]; then
    limits=()
    [[ ${STRENGTH:-} == true ]] && limits+=(--strength)
    read -rd '' -a increases <<<"${FAIL_ON_INCREASE:-}"
    for increase in "${increases[@]}"; do limits+=(--fail-on-increase "$increase"); done
    if ! git rev-parse --show-toplevel >/dev/null; then
        echo "gate.sh: git does not read this folder, so nothing is compared" >&2
        fails 2
    elif ! git rev-parse --verify --quiet "$BASE^{commit}" >/dev/null; then
        echo "gate.sh: there is no revision $BASE to compare with; a shallow clone does not contain it" >&2
        fails 2
    elif some_file_changed; then
        declare -A seen=()
        for pattern in "${frames[@]}"; do
            # The name of an existing file may contain brackets; it is then not a pattern.
            # shellcheck disable=SC2206
            if [[ -e $pattern ]]; then found=("$pattern"); else found=($pattern); fi
            for frame in "${found[@]}"; do
                [[ -n ${seen[$frame]:-} ]] && continue
                seen[$frame]=1
                compare "$frame"
            done
        done
    fi
fi
exit "$code"
