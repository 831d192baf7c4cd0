#!/usr/bin/env bash
# install.sh FOLDER: builds the program of this source tree into FOLDER/bin, unless it is there already.
# FOLDER is the folder that a job caches between runs; key.sh prints its cache key.
set -euo pipefail
folder=$1
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
key=$(bash "$source/docs/ci/key.sh")

if [[ -x $folder/bin/flexframe && $(cat "$folder/key" 2>/dev/null) == "$key" ]]; then
    echo "flexframe $key was kept"
    exit
fi
cargo build --release --locked --manifest-path "$source/Cargo.toml"
mkdir -p "$folder/bin"
cp "${CARGO_TARGET_DIR:-$source/target}/release/flexframe" "$folder/bin/flexframe"
echo "$key" >"$folder/key"
