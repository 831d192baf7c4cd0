"""plate_gcode.py MANIFEST PLATE GCODE: whether a slicer printed the plate that was meant: one line."""

import json
import re
import sys
import xml.etree.ElementTree as xml
import zipfile

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
# Infill is laid over walls a little, which counts twice; 15 % infill would leave 30 % and more of the material out.
MASS_RATIO = 0.03
# What the contrary profile wants of every kind of line, mm; the slicer rounds.
CONTRARY_LINE_MM = 0.7


def main(manifest, plate, gcode):
    volumes = {part["name"]: part["volume_mm3"] for part in json.load(open(manifest))["parts"]}
    model = xml.fromstring(zipfile.ZipFile(plate).read("3D/3dmodel.model"))
    names = {thing.get("id"): thing.get("name") for thing in model.iter(f"{CORE}object")}
    items = [names[item.get("objectid")] for item in model.iter(f"{CORE}item")]
    text = open(gcode).read()
    printed = {one for one in re.findall(r"^; printing object (.+)$", text, re.M)}
    if len(printed) != len(items):
        return f"FAILED: {len(printed)} objects are printed, {len(items)} are on the plate"
    heights = [float(one) for one in re.findall(r"^;Z:([0-9.]+)", text, re.M)]
    # Support has layers of its own in between.
    wanted = [heights[0] + 0.2 * layer for layer in range(10)]
    missing = [z for z in wanted if min(abs(z - height) for height in heights) > 1e-3]
    if missing:
        return f"FAILED: no layer at {missing[0]:.3f} mm, layers of 0.2 mm came with the plate"
    strange = [one for one in re.findall(r"^;WIDTH:([0-9.]+)", text, re.M) if abs(float(one) - CONTRARY_LINE_MM) < 1e-4]
    if strange:
        return f"FAILED: {len(strange)} lines of {CONTRARY_LINE_MM} mm, the widths of lines came with the plate"
    solid = sum(volumes[name] for name in items)
    used = 1e3 * float(re.search(r"; filament used \[cm3\] = ([0-9.]+)", text).group(1))
    # The support of the lid and the camera connectors is printed besides the parts.
    most = MASS_RATIO + (0.15 if "battery_lid" in items else 0)
    if not -MASS_RATIO < used / solid - 1 < most:
        return f"FAILED: {used:.0f} mm3 of filament for {solid:.0f} mm3 of parts, {100 * (used / solid - 1):+.1f} %"
    return f"ok {len(items)} objects, filament {100 * (used / solid - 1):+.1f} % of solid"


print(main(*sys.argv[1:]))
