#!/usr/bin/env bash
# gate.sh: holds frames against their limits, as a job of a build server. All of it is told by variables:
#
#   FLEXFRAME         the program; "flexframe" unless set
#   FRAMES            files or patterns, separated by spaces; "frames/*.toml" unless set
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
flexframe=${FLEXFRAME:-flexframe}
read -ra frames <<<"${FRAMES:-frames/*.toml}"

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

if [[ -n ${BASE:-} ]]; then
    limits=()
    for limit in ${FAIL_ON_INCREASE:-}; do limits+=(--fail-on-increase "$limit"); done
    for frame in ${frames[*]}; do
        # What is new has no former self, and what has not changed nothing to tell.
        [[ $frame == *.toml && -f $frame ]] && git cat-file -e "$BASE:./$frame" 2>/dev/null || continue
        git diff --quiet "$BASE" -- "$frame" && continue
        "$flexframe" diff --git "$BASE" --format markdown "${limits[@]}" "$frame" >>"${SUMMARY:-/dev/stdout}"
        grown=$?
        ((grown > code)) && code=$grown
    done
fi
exit "$code"
