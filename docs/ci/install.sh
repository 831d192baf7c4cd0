#!/usr/bin/env bash
# install.sh FOLDER [WHEEL]: puts the program into FOLDER/bin. WHEEL is what pip installs (flexframe==0.1.0, or the path of a wheel).
# Without it, the program of this source tree is built, unless it is there already. FOLDER is the folder that a job caches between
# runs; key.sh prints its cache key.
set -euo pipefail
folder=$1
wheel=${2:-}
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

if [[ -n $wheel ]]; then
    python3 -m venv --clear "$folder"
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --only-binary flexframe "$wheel"
    "$folder/bin/flexframe" --version
    exit
fi
key=$(bash "$source/docs/ci/key.sh")
if [[ -x $folder/bin/flexframe && $(cat "$folder/key" 2>/dev/null) == "$key" ]]; then
    echo "flexframe $key was kept"
    exit
fi
cargo build --release --locked --manifest-path "$source/Cargo.toml"
mkdir -p "$folder/bin"
cp "${CARGO_TARGET_DIR:-$source/target}/release/flexframe" "$folder/bin/flexframe"
echo "$key" >"$folder/key"
