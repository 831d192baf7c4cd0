"""orca_plates.py FOLDER...: one line a plate, and one a planted fault.

Reads the plates of built frames by the rules of the reader that Orca Slicer and Bambu Studio share, src/libslic3r/Format/bbs_3mf.cpp
(OrcaSlicer 00fcb7e5), src/slic3r/GUI/Plater.cpp (OrcaSlicer 008d13a5) and src/libslic3r/PrintConfig.{hpp,cpp} (OrcaSlicer 0019040b,
00063b88; BambuStudio 024e6832, 0015e42f), none of which is here:

- A file whose Application begins with "BambuStudio-" or "OrcaSlicer-" is a project of theirs, one of PrusaSlicer is geometry; any
  other is read with the settings of its objects as long as it brings no settings of a project.
- Metadata/model_settings.config is found by its name. Settings belong to the object of a build item, those of its parts override them.
  An object of several items is taken apart before settings are applied: only one of them would get any.
- A profile's own value holds where an object says nothing; a name that a program does not know is passed over.

Every object is laid over a profile that contradicts each setting. What Orca would then print has to be what PrusaSlicer's settings of
the same part say; the names of both stand here once more, apart from those of the program.
"""

import io
import sys
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MODEL, SETTINGS, PRUSA = "3D/3dmodel.model", "Metadata/model_settings.config", "Metadata/Slic3r_PE_model.config"
# What would replace the profile of the person who opens the file.
PROJECT = ("Metadata/project_settings.config", "Metadata/print_profile.config", "Metadata/process_settings_", "Metadata/filament_settings_",
           "Metadata/machine_settings_", "Metadata/Slic3r_PE.config")

# A profile that wants nothing that we want. Its names are all that both programs have of those that matter, and one that only Orca has.
CONTRARY = {
    "sparse_infill_density": "15%", "sparse_infill_pattern": "gyroid", "internal_solid_infill_pattern": "concentric",
    "infill_wall_overlap": "40%", "print_flow_ratio": "0.9", "layer_height": "0.33", "wall_loops": "7",
    "inner_wall_speed": "300", "outer_wall_speed": "200", "sparse_infill_speed": "270", "internal_solid_infill_speed": "250",
    "top_surface_speed": "190", "gap_infill_speed": "260", "small_perimeter_speed": "50%", "small_perimeter_threshold": "0",
    "brim_type": "auto_brim", "brim_width": "11", "line_width": "0.61", "inner_wall_line_width": "0.62", "outer_wall_line_width": "0.63",
    "sparse_infill_line_width": "0.64", "internal_solid_infill_line_width": "0.65", "top_surface_line_width": "0.66",
    "enable_support": "1", "support_type": "tree(manual)", "support_on_build_plate_only": "1",
    "elefant_foot_compensation": "0.15",
    "top_bottom_infill_wall_overlap": "41%",
}
ORCA_ALONE = {"top_bottom_infill_wall_overlap"}
# The words that are theirs, read as both programs read them.
WORDS = {"zig-zag": "rectilinear", "rectilinear": "rectilinear"}
# Only Orca knows this one by itself; Bambu Studio would refuse it.
NOT_BAMBU = {"rectilinear"}
ROLES = ("inner_wall", "outer_wall", "sparse_infill", "internal_solid_infill", "top_surface")
# PrusaSlicer's own bound of a short loop, mm.
SHORT_LOOP_MM = 6.5


def main(folders):
    plates = [plate for folder in folders for plate in sorted((Path(folder) / "plates").glob("*.3mf"))]
    for plate in plates:
        why = fault(plate.read_bytes())
        name = f"Orca's and Bambu's settings of {plate.parent.parent.name}/{plate.name}"
        print(f"FAILED {name}: {why}" if why else f"ok {name}", flush=True)
    for name, bytes_ in planted(plates[0].read_bytes()):
        print(f"ok planted: {name} is found" if fault(bytes_) else f"FAILED planted: {name} is not found", flush=True)


def fault(plate):
    archive = zipfile.ZipFile(io.BytesIO(plate))
    names = archive.namelist()
    model = xml.fromstring(archive.read(MODEL))
    application = next((one.text or "" for one in model.iter(f"{CORE}metadata") if one.get("name") == "Application"), "")
    if application.startswith(("BambuStudio-", "OrcaSlicer-")):
        return f"says that {application} wrote it"
    if "PrusaSlicer" in text_from_application(model):
        return "is taken for one of PrusaSlicer, whose settings are not read"
    brought = [name for name in names if name.startswith(PROJECT)]
    if brought:
        return f"brings settings of a project, {brought[0]}"
    if SETTINGS not in names:
        return f"has no {SETTINGS}"
    objects = {one.get("id"): one for one in model.iter(f"{CORE}object")}
    stated, why = read_settings(archive.read(SETTINGS))
    if why:
        return why
    wanted = prusa(archive.read(PRUSA))
    items = [one.get("objectid") for one in model.iter(f"{CORE}item")]
    if set(stated) != set(items):
        return f"states settings of the objects {sorted(stated)}, and has {sorted(set(items))}"
    for item in items:
        why = item_fault(item, items, objects, stated, wanted)
        if why:
            return f"object {item}: {why}"
    return None


def text_from_application(model):
    """All text from the name of the application on: the reader looks for PrusaSlicer's in all of it."""
    things = list(model.iter())
    begins = next((at for at, one in enumerate(things) if "Application" in one.get("name", "")), len(things))
    return " ".join(one.text or "" for one in things[begins:])


def item_fault(item, items, objects, stated, wanted):
    if items.count(item) > 1:
        return "stands on the plate several times: all but one copy lose their settings"
    meshes = parts_of(item, objects)
    own, volumes = stated[item]
    if [mesh for mesh in meshes if mesh not in volumes] or len(meshes) != 1:
        return f"has the meshes {meshes}, and settings of {sorted(volumes)}"
    [mesh] = meshes
    if own.get("name") != objects[mesh].get("name"):
        return f"is called {own.get('name')}, its mesh {objects[mesh].get('name')}"
    said = {**own, **volumes[mesh]}
    del said["name"]
    unknown = [key for key in said if key not in CONTRARY]
    if unknown:
        return f"says {unknown[0]}, which no object of both programs has"
    for program, known in (("Orca Slicer", set(CONTRARY)), ("Bambu Studio", set(CONTRARY) - ORCA_ALONE)):
        refused = [key for key, value in said.items() if program == "Bambu Studio" and value in NOT_BAMBU]
        if refused:
            return f"{program} does not know {refused[0]} = {said[refused[0]]}"
        effective = {key: said.get(key, value) if key in known else value for key, value in CONTRARY.items()}
        printed, meant = printed_by_orca(effective, known), meant_by_prusa(wanted[mesh])
        for what, value in meant.items():
            if printed[what] != value:
                return f"{program} prints {what} {printed[what]}, PrusaSlicer {value}"
    return None


def parts_of(item, objects):
    """Ids of the meshes of an object."""
    components = [one.get("objectid") for one in objects[item].iter(f"{CORE}component")]
    return [mesh for one in components for mesh in parts_of(one, objects)] if components else [item]


def read_settings(text):
    """Of each object its own settings and those of its parts."""
    stated = {}
    for thing in xml.fromstring(text):
        if thing.tag != "object":
            return None, f"<{thing.tag}> is not of an object: no plate and no assembly is stated here"
        if thing.get("id") in stated:
            return None, f"object {thing.get('id')} is stated twice, which ends the reading"
        volumes = {}
        for part in thing.findall("part"):
            if part.get("subtype") != "normal_part":
                return None, f"part {part.get('id')} is a {part.get('subtype')}, not printed"
            volumes[part.get("id")] = {one.get("key"): one.get("value") for one in part.findall("metadata") if one.get("key") != "name"}
        stated[thing.get("id")] = ({one.get("key"): one.get("value") for one in thing.findall("metadata")}, volumes)
    return stated, None


def prusa(text):
    return {
        thing.get("id"): {one.get("key"): one.get("value") for one in thing.findall("metadata")} for thing in xml.fromstring(text).iter("object")
    }


def printed_by_orca(setting, known):
    number = lambda key: float(setting[key].rstrip("%"))
    full = number("sparse_infill_density") > 99.9
    pattern = setting["internal_solid_infill_pattern" if full else "sparse_infill_pattern"]
    overlaps = {number(key) for key in ("infill_wall_overlap", "top_bottom_infill_wall_overlap") if key in known}
    brim = {"outer_only": number("brim_width"), "no_brim": 0.0}.get(setting["brim_type"], "as the slicer likes")
    return {
        "infill, %": number("sparse_infill_density"),
        "pattern": WORDS.get(pattern, pattern),
        "overlap, %": overlaps.pop() if len(overlaps) == 1 else sorted(overlaps),
        "layer, mm": number("layer_height"),
        "walls": number("wall_loops"),
        "speeds, mm/s": [number(f"{role}_speed") for role in ROLES],
        "speed in gaps, mm/s": number("gap_infill_speed"),
        "speed in short loops, mm/s": (number("small_perimeter_speed"), number("small_perimeter_threshold")),
        "brim, mm": brim,
        "widths, mm": [number(f"{role}_line_width") or number("line_width") for role in ROLES],
        "support": setting["enable_support"] == "1" and setting["support_type"].endswith("(auto)")
        and setting["support_on_build_plate_only"] == "0",
        "foot, mm": number("elefant_foot_compensation"),
        "flow": number("print_flow_ratio"),
    }


def meant_by_prusa(setting):
    """What is stated; of what is not, the slicer's own holds in both."""
    number = lambda key: float(setting[key].rstrip("%"))
    meant = {"flow": 1.0, "infill, %": number("fill_density"), "pattern": setting["fill_pattern"], "overlap, %": number("infill_overlap")}
    speeds = ("perimeter_speed", "external_perimeter_speed", "infill_speed", "solid_infill_speed", "top_solid_infill_speed")
    widths = ("perimeter", "external_perimeter", "infill", "solid_infill", "top_infill")
    for what, key in (("layer, mm", "layer_height"), ("walls", "perimeters"), ("speed in gaps, mm/s", "gap_fill_speed"),
                      ("foot, mm", "elefant_foot_compensation")):
        if key in setting:
            meant[what] = number(key)
    if speeds[0] in setting:
        meant["speeds, mm/s"] = [number(key) for key in speeds]
    meant["speed in short loops, mm/s"] = (number("small_perimeter_speed"), SHORT_LOOP_MM)
    if "brim_width" in setting:
        meant["brim, mm"] = number("brim_width") if setting["brim_type"] == "outer_only" else 0.0
    meant["widths, mm"] = [number(f"{kind}_extrusion_width") or number("extrusion_width") for kind in widths]
    meant["support"] = setting["support_material"] == "1" and setting.get("support_material_auto", "1") == "1"
    meant["support"] &= setting.get("support_material_buildplate_only", "0") == "0"
    return meant


def planted(plate):
    """Faults that the check has to find, each in a plate of its own."""
    archive = zipfile.ZipFile(io.BytesIO(plate))
    files = {name: archive.read(name) for name in archive.namelist()}
    model, settings = files[MODEL].decode(), files[SETTINGS].decode()
    first, second = [one.get("objectid") for one in xml.fromstring(files[MODEL]).iter(f"{CORE}item")][:2]

    def with_(name, text):
        return packed({**files, name: text.encode()})

    yield "no settings", packed({name: text for name, text in files.items() if name != SETTINGS})
    yield "another program's name", with_(MODEL, model.replace(">flexframe ", ">BambuStudio-"))
    yield "text of PrusaSlicer", with_(MODEL, model.replace("<resources>", "<metadata name=\"Note\">for PrusaSlicer</metadata><resources>"))
    yield "a project", packed({**files, "Metadata/project_settings.config": b"{}"})
    yield "two copies of one object", with_(MODEL, model.replace(f'<item objectid="{second}"', f'<item objectid="{first}"'))
    yield "a setting that was left out", with_(SETTINGS, settings.replace('<metadata key="wall_loops" value="2"/>', "", 1))
    yield "a width of one kind of line that was left out", without(with_, settings, "outer_wall_line_width")
    yield "a brim of the slicer's choice", without(with_, settings, "brim_type")
    yield "a setting of the part over that of the object", with_(
        SETTINGS, settings.replace('subtype="normal_part">', 'subtype="normal_part"><metadata key="wall_loops" value="9"/>', 1))
    yield "a word that Bambu Studio does not know", with_(SETTINGS, settings.replace('"zig-zag"', '"rectilinear"'))
    yield "a name that no object has", with_(SETTINGS, settings.replace('key="wall_loops"', 'key="perimeters"', 1))


def without(with_, settings, key):
    at = settings.index(f'<metadata key="{key}"')
    return with_(SETTINGS, settings[:at] + settings[settings.index("/>", at) + 2 :])


def packed(files):
    bytes_ = io.BytesIO()
    with zipfile.ZipFile(bytes_, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return bytes_.getvalue()


main(sys.argv[1:])
