#!/usr/bin/env bash
# run.sh SECONDS [TARGET...]: tries each target (all unless named) for so long, and says how many inputs that were. What reaches something
# new is gathered in fuzz/working, what fails in fuzz/artifacts. cargo-fuzz has to be there: cargo install cargo-fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=$1
shift
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || mapfile -t targets < <(basename -s .rs fuzz/fuzz_targets/*.rs)
# The flags of the coverage counters are not stable yet; no sanitizer is needed where no code is unsafe.
export RUSTC_BOOTSTRAP=1
failed=0
for target in "${targets[@]}"; do
    folders=(fuzz/working/"$target" fuzz/corpus/"$target" fuzz/regressions/"$target")
    mkdir -p "${folders[@]}"
    log=fuzz/working/$target.log
    if cargo fuzz run --sanitizer none "$target" "${folders[@]}" -- \
        -max_total_time="$seconds" -max_len=4096 -timeout=5 -rss_limit_mb=2048 -print_final_stats=1 >"$log" 2>&1; then
        echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs"
    else
        echo "FAILED $target: see $log and fuzz/artifacts/$target"
        failed=1
    fi
    rmdir --ignore-fail-on-non-empty fuzz/regressions/"$target"
done
exit "$failed"
