"""cura_plates.py DEFINITION FOLDER...: one line a plate, and one a planted fault.

Reads the plates of built frames with libSavitar, the library by which Cura reads 3MF, and holds what it finds against DEFINITION, Cura's
own fdmprinter.def.json: every setting of an object is one that Cura lets an object have, with a value of its type; and what they say is
what PrusaSlicer's settings of the same part say. The names of both stand here once more, apart from those of the program.
"""

import io
import json
import sys
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

import Savitar

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MODEL, PRUSA = "3D/3dmodel.model", "Metadata/Slic3r_PE_model.config"
PAIRS = {
    "infill_sparse_density": "fill_density", "wall_line_count": "perimeters", "speed_wall_x": "perimeter_speed",
    "speed_wall_0": "external_perimeter_speed", "speed_infill": "infill_speed", "speed_topbottom": "top_solid_infill_speed",
    "line_width": "extrusion_width", "wall_line_width_0": "external_perimeter_extrusion_width",
    "wall_line_width_x": "perimeter_extrusion_width", "skin_line_width": "top_infill_extrusion_width",
    "infill_line_width": "infill_extrusion_width", "xy_offset_layer_0": "elefant_foot_compensation",
}
FLOWS = ("material_flow", "wall_0_material_flow", "wall_x_material_flow", "skin_material_flow", "infill_material_flow")


def main(definition, folders):
    known = dict(settings(json.loads(Path(definition).read_text())["settings"], True))
    plates = [plate for folder in folders for plate in sorted((Path(folder) / "plates").glob("*.3mf"))]
    for plate in plates:
        archive = zipfile.ZipFile(plate)
        why = fault(archive.read(MODEL).decode(), archive.read(PRUSA), known)
        name = f"Cura's settings of {plate.parent.parent.name}/{plate.name}"
        print(f"FAILED {name}: {why}" if why else f"ok {name}", flush=True)
    archive = zipfile.ZipFile(plates[0])
    model, prusa = archive.read(MODEL).decode(), archive.read(PRUSA)
    for name, old, new in (
        ("a setting that was left out", '<metadata name="cura:wall_line_count">2</metadata>', ""),
        ("a setting that Cura has for the plate alone", "cura:wall_line_count", "cura:layer_height"),
        ("a word that Cura does not know", ">lines<", ">rectilinear<"),
        ("names that are not of Cura", "\"cura:", "\"slic3rpe:"),
    ):
        assert old in model, old
        print(f"ok planted: {name} is found" if fault(model.replace(old, new), prusa, known) else f"FAILED planted: {name} is not found")


def settings(tree, of_mesh):
    """Every setting with its record, and whether an object may have it; a child is as its parent unless it says so."""
    for key, record in tree.items():
        own = record.get("settable_per_mesh", of_mesh)
        yield key, (record, own)
        yield from settings(record.get("children", {}), True if record["type"] == "category" else own)


def fault(model, prusa, known):
    wanted = {
        thing.get("id"): {one.get("key"): one.get("value") for one in thing.findall("metadata")} for thing in xml.fromstring(prusa).iter("object")
    }
    by_name = {setting["name"]: setting for setting in wanted.values()}
    nodes = Savitar.ThreeMFParser().parse(model).getSceneNodes()
    if len(nodes) != len(list(xml.fromstring(model).iter(f"{CORE}item"))):
        return f"Cura finds {len(nodes)} objects"
    for node in nodes:
        meshes = node.getChildren()
        # Cura puts the child of a group of one in its place, and with it goes what is said of the group.
        if len(meshes) != 1:
            return f"{node.getName()} is a group of {len(meshes)}"
        said = {key: entry if isinstance(entry, str) else entry.value for key, entry in meshes[0].getSettings().items()}
        why = said_fault(said, by_name[meshes[0].getName()], known)
        if why:
            return f"{meshes[0].getName()}: {why}"
    return None


def said_fault(said, prusa, known):
    for key, value in said.items():
        if key not in known or not known[key][1]:
            return f"{key} is no setting of an object"
        record = known[key][0]
        if record["type"] == "enum" and value not in record["options"]:
            return f"{key} = {value} is none of {sorted(record['options'])}"
        if record["type"] == "bool" and value not in ("True", "False"):
            return f"{key} = {value} is neither True nor False"
    number = lambda text: float(text.rstrip("%"))
    for key, ours in PAIRS.items():
        if (key in said) != (ours in prusa) or (key in said and number(said[key]) != number(prusa[ours])):
            return f"{key} is {said.get(key)}, PrusaSlicer has {prusa.get(ours)}"
    if any(said.get(key) != "100" for key in FLOWS):
        return "its flow is not 100 %"
    if said.get("support_enable") != {"1": "True", "0": "False"}[prusa["support_material"]]:
        return f"support is {said.get('support_enable')}, PrusaSlicer has {prusa['support_material']}"
    if {said.get("infill_pattern"), said.get("top_bottom_pattern")} != {"lines"} or prusa["fill_pattern"] != "rectilinear":
        return f"it is filled with {said.get('infill_pattern')}, PrusaSlicer with {prusa['fill_pattern']}"
    stated = set(PAIRS) | set(FLOWS) | {"support_enable", "infill_pattern", "top_bottom_pattern"}
    return next((f"{key} is not looked at here" for key in said if key not in stated), None)


main(sys.argv[1], sys.argv[2:])
