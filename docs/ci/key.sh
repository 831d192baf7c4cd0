#!/usr/bin/env bash
# key.sh: prints a cache key for the program of this source tree: a hash of its sources.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
find src params build.rs Cargo.toml Cargo.lock -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -c1-16
