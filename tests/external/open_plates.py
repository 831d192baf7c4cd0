"""open_plates.py BINARY PRINTERS WORK: one line a printer.

Builds the default frame for each printer of the folder PRINTERS, has PrusaSlicer open every plate and write down, without arranging
anything, what it read; then each part is there as often as the manifest says, has the size that it says, lies on that printer's bed and
under its height, and no two boxes of parts touch.
"""

import itertools
import json
import math
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as xml
import zipfile
from collections import Counter
from pathlib import Path

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
# PrusaSlicer writes nine digits.
LENGTH_MM = 1e-3


def main(binary, printers, work):
    for file in sorted(Path(printers).glob("*.toml")):
        frame = Path(work) / f"on-{file.stem}.toml"
        frame.parent.mkdir(parents=True, exist_ok=True)
        frame.write_text(f'base = "cognifly"\nprinter = "{file.stem}"\n')
        subprocess.run([binary, "build", frame, "--no-pictures", "--quiet", "--output", work], check=True, timeout=1200)
        folder = Path(work) / frame.stem
        why = fault(folder, tomllib.loads(file.read_text()))
        print(f"FAILED plates on {file.stem}: {why}" if why else f"ok plates on {file.stem}", flush=True)


def fault(folder, printer):
    manifest = json.loads((folder / "manifest.json").read_text())
    sizes = {part["name"]: part["bbox_mm"] for part in manifest["parts"]}
    found = Counter()
    for plate in sorted((folder / "plates").glob("*.3mf")):
        boxes = []
        for name, low, high, size in as_read(plate):
            found[name] += 1
            if any(abs(a - b) > LENGTH_MM for a, b in zip(size, sizes[name])):
                return f"{plate.name}: {name} is {size} mm, not {sizes[name]}"
            if low[2] < -LENGTH_MM or high[2] > printer["height_mm"] or not on_bed(printer, low, high):
                return f"{plate.name}: {name} is off the bed, from {low} to {high}"
            boxes.append((name, low, high))
        for (a, low_a, high_a), (b, low_b, high_b) in itertools.combinations(boxes, 2):
            if all(low_a[i] < high_b[i] and low_b[i] < high_a[i] for i in (0, 1)):
                return f"{plate.name}: {a} and {b} lie in each other"
    wanted = {part["name"]: part["quantity"] for part in manifest["parts"]}
    return None if found == wanted else f"hold {dict(found)}, not {wanted}"


def on_bed(printer, low, high):
    if printer["bed"] == "round":
        return all(math.hypot(x, y) <= 0.5 * printer["size_mm"][0] + LENGTH_MM for x in (low[0], high[0]) for y in (low[1], high[1]))
    return all(low[i] >= -LENGTH_MM and high[i] <= printer["size_mm"][i] + LENGTH_MM for i in (0, 1))


def as_read(plate):
    """Name, lowest and highest corner on the bed, and size before it was turned, of every copy, as the slicer read them."""
    # Beside the folder: another run looks at every plate in it.
    again = plate.parent.parent / f"{plate.stem}.again.3mf"
    command = ["prusa-slicer", "--dont-arrange", "--export-3mf", "--output", again, plate]
    subprocess.run(command, check=True, timeout=600, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    archive = zipfile.ZipFile(again)
    names = {
        thing.get("id"): next(one.get("value") for one in thing.iter("metadata") if one.get("key") == "name")
        for thing in xml.fromstring(archive.read("Metadata/Slic3r_PE_model.config")).iter("object")
    }
    model = xml.fromstring(archive.read("3D/3dmodel.model"))
    corners = {
        thing.get("id"): [[float(one.get(axis)) for axis in "xyz"] for one in thing.iter(f"{CORE}vertex")]
        for thing in model.iter(f"{CORE}object")
    }
    # A further copy is an object of its own that refers to the first.
    first = {thing.get("id"): one.get("objectid") for thing in model.iter(f"{CORE}object") for one in thing.iter(f"{CORE}component")}
    for item in model.iter(f"{CORE}item"):
        m = [float(one) for one in item.get("transform").split()]
        own = first.get(item.get("objectid"), item.get("objectid"))
        points = corners[own]
        placed = [[sum(p[k] * m[3 * k + i] for k in range(3)) + m[9 + i] for i in range(3)] for p in points]
        low, high = ([pick(p[i] for p in placed) for i in range(3)] for pick in (min, max))
        size = [max(p[i] for p in points) - min(p[i] for p in points) for i in range(3)]
        yield names[own], low, high, size


main(*sys.argv[1:])
