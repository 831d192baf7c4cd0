#!/usr/bin/env bash
# key.sh: prints a cache key for the program of this source tree: a hash of its sources and of the compiler.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
{
    find src params build.rs Cargo.toml Cargo.lock -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum
    rustc -vV 2>/dev/null || true
} | sha256sum | cut -c1-16
