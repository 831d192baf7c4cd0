#!/usr/bin/env bash
# address.sh URL: states in Cargo.toml where the source tree is published. Installers download from there, so whoever publishes a release
# states an address of their own; release.yml does it for the run, without a commit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[[ $1 =~ ^https://[A-Za-z0-9._/-]+$ ]] || { echo "address.sh: $1 is not an address such as https://github.com/OWNER/flexframe" >&2; exit 2; }
if grep -q '^repository = ' Cargo.toml; then
    sed -i.former "s|^repository = .*|repository = \"$1\"|" Cargo.toml
else
    sed -i.former "/^description = /a\\
repository = \"$1\"
" Cargo.toml
fi
rm Cargo.toml.former
