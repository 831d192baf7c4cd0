#!/usr/bin/env bash
# gate.sh: holds frames against their limits, as a job of a build server. It needs bash 4.4 or later. All of it is told by variables:
#
#   FLEXFRAME         the program; "flexframe" unless set
#   FRAMES            presets, files or patterns, separated by spaces; "frames/*.toml" unless set
#   FORMAT            github (annotations) or text
#   STRICT            true: notes beyond their figure fail
#   BASELINE          a list of accepted findings
#   BASE              a revision; each frame that was there is compared with what it was
#   FAIL_ON_INCREASE  what may not grow against BASE, as mass=2g, separated by spaces
#   SUMMARY           a file that takes the page in Markdown, appended
#   JUNIT, SARIF      files that take the reports
#
# Exit code: 0 good, 1 a limit is violated or something grew too much, 2 an input is wrong, 3 the machine failed.
set -uo pipefail
# As the program reads patterns: ** is any number of folders, and what begins with a dot is a file, too.
shopt -s globstar nullglob dotglob || exit 3
flexframe=${FLEXFRAME:-flexframe}
read -rd '' -a frames <<<"${FRAMES:-frames/*.toml}"

options=()
[[ ${STRICT:-} == true ]] && options+=(--strict)
[[ -n ${BASELINE:-} ]] && options+=(--baseline "$BASELINE")

check() { "$flexframe" check "${options[@]}" "$@" -- "${frames[@]}"; }

# The first call measures and keeps what it found; the others only say it in another form.
check --format "${FORMAT:-text}"
code=$?
[[ -n ${JUNIT:-} ]] && check --format junit >"$JUNIT" 2>/dev/null
[[ -n ${SARIF:-} ]] && check --format sarif >"$SARIF" 2>/dev/null
[[ -n ${SUMMARY:-} ]] && check --format markdown >>"$SUMMARY" 2>/dev/null

# fails CODE: the worst code is that of the job.
fails() { (($1 > code)) && code=$1; }

# A frame is made of its bases, too: it may be another one although its own file is the same.
some_file_changed() {
    ! git diff --quiet "$BASE" -- ':/*.toml' || [[ -n $(git ls-files --others --exclude-standard -- ':/*.toml') ]]
}

compare() {
    local page grown
    # What is new has no former self.
    [[ $1 == *.toml && -f $1 ]] && git cat-file -e "$BASE:./$1" 2>/dev/null || return
    page=$("$flexframe" diff --git "$BASE" --format markdown "${limits[@]}" -- "$1")
    grown=$?
    fails "$grown"
    # One that is what it was has nothing to tell.
    [[ -z $page || $page == *$'\nNo difference.'* ]] || printf '%s\n' "$page" >>"${SUMMARY:-/dev/stdout}"
}

if [[ -n ${BASE:-} ]]; then
    limits=()
    read -rd '' -a increases <<<"${FAIL_ON_INCREASE:-}"
    for increase in "${increases[@]}"; do limits+=(--fail-on-increase "$increase"); done
    if ! git rev-parse --verify --quiet "$BASE^{commit}" >/dev/null; then
        echo "gate.sh: there is no revision $BASE to compare with; a shallow clone lacks it" >&2
        fails 2
    elif some_file_changed; then
        declare -A seen=()
        for pattern in "${frames[@]}"; do
            # A file may have brackets in its name; then it is no pattern.
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
