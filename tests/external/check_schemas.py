"""check_schemas.py BINARY TAPLO WORK: our schemas, by taplo and jsonschema, on what comes with the program and on mistakes."""
import json
import subprocess
import sys
import tomllib
from pathlib import Path

import jsonschema

BINARY, TAPLO, WORK = sys.argv[1], sys.argv[2], Path(sys.argv[3]).resolve()

GOOD = {
    "frame": sorted(Path("params/frames").glob("*.toml")),
    "model": sorted(Path("params/impact").glob("*.toml")),
    "plan": sorted(Path("params/synthetic").glob("*.toml")),
    "study": sorted(Path("examples/studies").glob("*.toml")),
    "mechanics": [Path("params/mechanics.toml")],
    "bought": [Path("params/bought.toml")],
    "materials": [Path("params/materials.toml")],
    "printer": sorted(Path("params/printers").glob("*.toml")),
}
BASE = 'base = "cognifly"\n'
MISTAKES = {
    "unknown key": ("frame", BASE + "[rods]\ncage_rod_lenght_mm = 190.0\n"),
    "unknown table": ("frame", BASE + "[rod]\ncage_rod_length_mm = 190.0\n"),
    "wrong type": ("frame", BASE + '[rods]\ncage_rod_length_mm = "long"\n'),
    "out of bounds": ("frame", BASE + "[corner]\ncorner_wall_mm = 0.3\n"),
    "name that leads out": ("frame", BASE + 'name = "../up"\n'),
    "extra without a source": ("frame", BASE + '[extras.x]\nmass_g = 1.0\nmass_basis = "measured"\n'),
    "unknown role": ("frame", BASE + '[bought]\nwings = "none"\n'),
    "override of no figure": ("frame", BASE + "[override.parts.x]\nweight = 1.0\n"),
    "unknown effect": ("model", Path("params/impact/paper.toml").read_text() + "\n[effects.magic]\nk = 1\n"),
    "model without mass": ("model", Path("params/impact/paper.toml").read_text().replace("mass_kg", "# mass_kg")),
    "plan without drops": ("plan", Path("params/impact/paper.toml").read_text()),
    "study with a number of no range": ("study", "[vary]\narm_rod = 80\n"),
    "study of a measure that is none": ("study", 'measures = ["weight"]\n[vary]\narm_rod = [70, 90]\n'),
    "study of frames with seeds": ("study", "[vary]\narm_rod = [70, 90]\n[seeds]\none = [1, 2]\n"),
    "study of hidden effects that varies a rod": ("study", 'kind = "recovery"\n[seeds]\none = [1, 2]\n[vary]\narm_rod = [70, 90]\n'),
    "study of an unknown sampling": ("study", 'sampling = "random"\n[vary]\narm_rod = [70, 90]\n'),
    "mechanics without a number": ("mechanics", Path("params/mechanics.toml").read_text().replace("poisson", "# poisson")),
    "mechanics out of bounds": ("mechanics", Path("params/mechanics.toml").read_text().replace("friction = ", "friction = 3")),
    "printer with a wrong bed": ("printer", Path("params/printers/prusa-mini.toml").read_text().replace("rectangular", "oval")),
}


def result(name, good, why=""):
    print(f"ok {name}" if good else f"FAILED {name}: {' '.join(str(why).split())[:300]}", flush=True)


def main():
    validators, paths = {}, {}
    for kind in [*GOOD, "baseline"]:
        text = subprocess.run([BINARY, "schema", kind], capture_output=True, text=True, check=True).stdout
        paths[kind] = WORK / f"{kind}.schema.json"
        paths[kind].write_text(text)
        schema = json.loads(text)
        jsonschema.Draft7Validator.check_schema(schema)
        validators[kind] = jsonschema.Draft7Validator(schema)

    def faults(kind, text):
        return [f"{list(error.path)}: {error.message}" for error in validators[kind].iter_errors(tomllib.loads(text))]

    def taplo(kind, file):
        done = subprocess.run([TAPLO, "check", "--schema", f"file://{paths[kind]}", str(file)], capture_output=True, text=True)
        return done.returncode, done.stderr

    result("jsonschema: an extra of the base in part fits", not (found := faults("frame", BASE + "[extras.wiring]\nmass_g = 9.0\n")), found)
    for kind, files in GOOD.items():
        found = {str(file): faults(kind, file.read_text()) for file in files}
        result(f"jsonschema: {len(files)} of kind {kind} fit", not any(found.values()), found)
    for kind, file in (("frame", GOOD["frame"][0]), ("model", GOOD["model"][0]), ("bought", GOOD["bought"][0]), ("study", Path("examples/studies/recovery-laws.toml")), ("mechanics", GOOD["mechanics"][0])):
        code, said = taplo(kind, file)
        result(f"taplo: {file} fits", code == 0, said)
    # As an editor finds it: the file names its schema.
    named = WORK / "named.toml"
    named.write_text(f"#:schema file://{paths['frame']}\n{BASE}[rods]\ncage_rod_length_mm = 9000.0\n")
    done = subprocess.run([TAPLO, "check", str(named)], capture_output=True, text=True)
    result("taplo: #:schema is followed", done.returncode != 0 and "9000" in done.stderr, done.stderr)
    for name, (kind, text) in MISTAKES.items():
        file = WORK / "mistake.toml"
        file.write_text(text)
        code, said = taplo(kind, file)
        found = faults(kind, text)
        result(f"schema: {name} is found", found and code != 0, f"jsonschema {found}, taplo {code} {said}")


main()
