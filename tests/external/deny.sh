#!/usr/bin/env bash
# deny.sh PYTHON WORK: cargo-deny on the libraries by deny.toml, and the notes on crates with unsafe code; one line a result. The list of
# known vulnerabilities is asked where it can be fetched, and skipped by name where it cannot. cargo-deny lies beside PYTHON.
set -uo pipefail
python=$1
work=$2
deny=$(dirname "$python")/cargo-deny
log=$work/deny.log

for check in licenses bans sources; do
    if "$deny" --locked check "$check" >"$log" 2>&1; then echo "ok cargo deny: $check"; else echo "FAILED cargo deny: $check: $(grep -m 3 '^error' "$log" | tr '\n' ' ')"; fi
done

# What is not allowed is found: a list without MIT, and a second version of a crate that nothing excuses.
sed '/^  "MIT",$/d' deny.toml >"$work/no-mit.toml"
sed '/crate = "rand@0.8"/d' deny.toml >"$work/no-skip.toml"
for planted in "no-mit.toml licenses rejected" "no-skip.toml bans duplicate"; do
    read -r file check word <<<"$planted"
    if "$deny" --locked --config "$work/$file" check "$check" >"$log" 2>&1 || ! grep -q "$word" "$log"; then
        echo "FAILED cargo deny finds what $file does not allow: $(tail -n 1 "$log")"
    else
        echo "ok cargo deny finds what $file does not allow"
    fi
done

code=0
timeout 120 "$deny" --locked check advisories >"$log" 2>&1 || code=$?
if [[ $code == 0 ]]; then
    echo "ok cargo deny: advisories"
elif [[ $code == 124 ]] || grep -q 'failed to fetch advisory database' "$log"; then
    echo "skipped cargo deny: advisories: the list of RustSec could not be fetched"
else
    echo "FAILED cargo deny: advisories: $(grep -m 3 '^error' "$log" | tr '\n' ' ')"
fi
"$python" tests/external/unsafe_crates.py docs/dependencies.md
