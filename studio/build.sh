#!/usr/bin/env bash
# Makes studio/dist/: the engine, the library as a WebAssembly module with what loads it, and the page on it.
#
#   bash studio/build.sh                  as it is published: small and fast
#   bash studio/build.sh quick            in half the time, for tests: larger, slower, the same results
#   bash studio/build.sh release page     only the page, on the engine that is there; `engine`: only the engine
#
# The page takes Node 20.19 or later and npm; what it needs is listed in page/package-lock.json.
#
# Takes the target wasm32-unknown-unknown of the Rust that is there (`rustup target add wasm32-unknown-unknown`), or else
# Debian's rustc-web, which comes with the sources of its standard library:
#   apt-get install rustc-web cargo-web rust-web-src libstd-rust-web-dev lld
set -euo pipefail
cd "$(dirname "$0")"

profile=${1:-release}
what=${2:-all}
target=wasm32-unknown-unknown
build=(build --manifest-path wasm/Cargo.toml --profile "$profile" --target "$target" --locked)

engine() {
    if [[ -d $(rustc --print sysroot 2>/dev/null)/lib/rustlib/$target/lib ]]; then
        cargo "${build[@]}"
    elif [[ -x /usr/bin/cargo && -f /usr/lib/rustlib/src/rust/library/std/Cargo.toml && -x $(command -v wasm-ld) ]]; then
        # The standard library is compiled, too, for which a stable compiler has to be told that it may.
        export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=wasm-ld
        /usr/bin/cargo "${build[@]}" -Z build-std=std,panic_abort
    else
        echo "There is no Rust for $target: rustup target add $target, or what the head of $0 names." >&2
        exit 2
    fi
    mkdir -p dist/engine
    cp "${CARGO_TARGET_DIR:-wasm/target}/$target/$profile/flexframe_engine.wasm" dist/engine/engine.wasm
    cp engine.mjs dist/engine/
}

page() {
    if ! command -v npm >/dev/null; then
        echo "There is no npm: install Node 20.19 or later for the page, or build the engine alone: bash $0 $profile engine" >&2
        exit 2
    fi
    cd page
    # What the lock file lists, and nothing when it is there.
    if [[ ! -f node_modules/.package-lock.json || package-lock.json -nt node_modules/.package-lock.json ]]; then
        for attempt in 1 2 3; do
            PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 npm ci --no-audit --no-fund && break
            [[ $attempt != 3 ]] || exit 3
        done
        touch node_modules/.package-lock.json
    fi
    rm -rf ../dist/assets
    # Results of another engine are of no use.
    if [[ ! ../dist/engine/prepared.bin -nt ../dist/engine/engine.wasm ]]; then node ../prepare.mjs ../dist/engine; fi
    npm run --silent build
    cd ..
}

if [[ $what == all || $what == engine ]]; then engine; fi
if [[ $what == all || $what == page ]]; then page; fi
ls -l dist dist/engine
