#!/usr/bin/env bash
# comment.sh: comments on a pull request what changed in masses and margins, once: a later run edits its own comment.
# Variables: FLEXFRAME, FRAMES, STRICT, BASELINE and BASE as in gate.sh; PULL_REQUEST is the number, GH_REPO the repository, GH_TOKEN the token of `gh`.
# The token of a pull request from a fork may not write. Then the table stands in the log, and the job goes on.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# The first line, by which a later run finds its comment.
mark="<!-- flexframe: masses and margins -->"
page=$(mktemp)
trap 'rm -f "$page"' EXIT

{ echo "$mark"; python3 "$here/changes.py" "$BASE"; } >"$page"
cat "$page"
# Only a comment of a bot is ours: anybody may begin one with the mark.
ours=".[] | select(.user.type == \"Bot\" and (.body | startswith(\"$mark\"))) | .id"
found=$(gh api --paginate "repos/$GH_REPO/issues/$PULL_REQUEST/comments" --jq "$ours") || found=""
own=${found%%$'\n'*}
if [[ -n $own ]]; then
    said=$(gh api --method PATCH "repos/$GH_REPO/issues/comments/$own" --field "body=@$page" 2>&1) && exit
else
    said=$(gh api --method POST "repos/$GH_REPO/issues/$PULL_REQUEST/comments" --field "body=@$page" 2>&1) && exit
fi
echo "::notice title=flexframe::the comment could not be written; it needs the permission pull-requests: write. $(head -n 1 <<<"$said")"
