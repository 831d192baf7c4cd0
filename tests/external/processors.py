"""Results do not depend on the processor, the locale or the time zone.

    processors.py FLEXFRAME FOLDER [COMMAND...]

Each command runs on this processor, and on an emulated one without AVX and FMA (qemu-x86_64 -cpu Nehalem). Everything that is printed and
written has to be the same, byte by byte. Without commands: fit and diagnose. `stiffness` takes some minutes more. One line a result."""

import filecmp
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
EMULATED = ["qemu-x86_64", "-cpu", "Nehalem"]
PLAN = """mass_kg = 0.241
gap_mm = 16.0
[sensor]
cutoff_hz = 79.57747154594767
order = 1
limit_g = 230.0
channel = "axial"
[effects.linear_spring]
k = 6600.0
[effects.linear_damper]
c = 50.0
[effects.bottoming]
x_b_mm = 11.0
k_b = 1.0e6
[drops]
heights_m = [0.5, 1.0, 1.5]
count = 6
"""
COMMANDS = {
    "fit": ["fit", "drops.csv", "--json"],
    "diagnose": ["diagnose", "drops.csv", "--json"],
    "stiffness": ["stiffness", "cognifly", "--json"],
}


def result(name, good, why=""):
    print(f"ok {name}" if good else f"FAILED {name}: {why}", flush=True)


def differing(one, other):
    """Files that are not the same in both folders."""
    names = {path.relative_to(folder) for folder in (one, other) for path in folder.rglob("*") if path.is_file()}
    return sorted(str(name) for name in names
                  if not (one / name).is_file() or not (other / name).is_file() or not filecmp.cmp(one / name, other / name, shallow=False))


def run(before, name, place, env):
    place.mkdir(parents=True)
    shutil.copy(FOLDER / "drops/synthesize-plan/drops/drops.csv", place)
    words = [*before, PROGRAM, *COMMANDS[name], "--no-cache", "-q", "-o", "out"]
    done = subprocess.run(words, cwd=place, env={**os.environ, **env}, capture_output=True, timeout=3600)
    (place / "printed").write_bytes(done.stdout)
    return done.returncode


def has_avx():
    return " avx2 " in pathlib.Path("/proc/cpuinfo").read_text().replace("\n", " ")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "plan.toml").write_text(PLAN)
    subprocess.run([PROGRAM, "synthesize", FOLDER / "plan.toml", "-q", "-o", FOLDER / "drops"], check=True)
    if not has_avx():
        print("skipped a processor without AVX beside this one: this one has none either", flush=True)
    for name in sys.argv[3:] or ["fit", "diagnose"]:
        places = [FOLDER / name / kind for kind in ("native", "emulated", "elsewhere")]
        codes = [
            run([], name, places[0], {}),
            run(EMULATED, name, places[1], {}),
            run([], name, places[2], {"LC_ALL": "de_DE.UTF-8", "TZ": "Asia/Kolkata", "RAYON_NUM_THREADS": "1"}),
        ]
        for what, code, place in zip(("without AVX and FMA", "in another locale and time zone, on one thread"), codes[1:], places[1:]):
            off = differing(places[0], place)
            filled = (places[0] / "printed").stat().st_size > 100
            result(f"{name} {what}: the same bytes", not off and code == codes[0] and filled, f"exit codes {codes}, differing {off}")


main()
