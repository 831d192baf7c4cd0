"""plate_gcode.py MANIFEST PLATE GCODE: whether a slicer printed the plate that was meant: one line."""

import json
import re
import sys
import xml.etree.ElementTree as xml
import zipfile

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
# Lines overlap a little where walls are narrow; 15 % infill would leave 30 % and more of the material out.
MASS_RATIO = 0.05


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
    if round(heights[2] - heights[1], 6) != 0.2:
        return f"FAILED: layers of {heights[2] - heights[1]:.3f} mm, 0.2 came with the plate"
    solid = sum(volumes[name] for name in items)
    used = 1e3 * float(re.search(r"; filament used \[cm3\] = ([0-9.]+)", text).group(1))
    # A lid's support is printed on top of the part.
    most = MASS_RATIO + (0.15 if "battery_lid" in items else 0)
    if not -MASS_RATIO < used / solid - 1 < most:
        return f"FAILED: {used:.0f} mm3 of filament for {solid:.0f} mm3 of parts, {100 * (used / solid - 1):+.1f} %"
    return f"ok {len(items)} objects, filament {100 * (used / solid - 1):+.1f} % of solid"


print(main(*sys.argv[1:]))
