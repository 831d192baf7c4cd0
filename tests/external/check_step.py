"""check_step.py FOLDER...: OCCT (through CadQuery's binding) reads every STEP file of frames built with `build --step`.

Each file is read in a process of its own with a time limit. A part must be exact, but for those that are known to be exact in part alone, and one valid, closed
solid with the volume that the manifest gives for the mesh, within 0.5 % (a tube within 0.7 %: chords narrow its bore, too), and with its own, within 0.02 %. OCCT's integral over trimmed faces was found 0.03 % off its own triangulation
where a solid has many faces, so the finer of the two decides where the integral is beyond the limit. The assembly must have the names, places and colours
of `frame.glb`, and each solid in it must be as good as a part; screws and ties that are one shape are as many solids as pieces. One line a file: "ok NAME" or "FAILED NAME: WHY".
"""

import importlib
import json
import multiprocessing
import struct
import sys
from pathlib import Path

# Seconds for one file; the assembly takes about 40 alone on a slow machine.
LIMIT_S = 600

# Shares by which volumes may differ: from the mesh, whose arcs are chords, and from what we say ourselves.
FROM_MESH, FROM_OURS = 0.005, 0.0002
# Of rods, which may be tubes.
FROM_MESH_OF_RODS = 0.007

# Frame and part that are exact in part alone, and have to be valid all the same.
MIXED = {("passing", "hub")}

PLACE_MM, COLOUR = 0.002, 0.01

# Loaded once: a process of each file's own begins with them.
LOADED_AHEAD = ["BRep", "BRepCheck", "BRepGProp", "BRepMesh", "STEPCAFControl", "STEPControl", "TopExp", "XCAFDoc"]


def explore(shape, kind):
    from OCP.TopExp import TopExp_Explorer

    found, explorer = [], TopExp_Explorer(shape, kind)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def volume_of(solid):
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, properties)
    return properties.Mass()


def triangulated_volume_of(solid):
    """By OCCT's triangles, whose edges lie this far from the faces at most: 0.0002 mm."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    BRepMesh_IncrementalMesh(solid, 0.0002, False, 0.02)
    volume = 0.0
    for face in map(TopoDS.Face_s, explore(solid, TopAbs_FACE)):
        place = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, place)
        move, sign = place.Transformation(), -1 if face.Orientation() == TopAbs_REVERSED else 1
        for at in range(1, mesh.NbTriangles() + 1):
            a, b, c = (mesh.Node(node).Transformed(move).Coord() for node in mesh.Triangle(at).Get())
            volume += sign * sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3)) / 6
    return volume


def faults_of(shape, entry):
    """What is wrong with a shape that should be as many solids as the entry has pieces."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.TopAbs import TopAbs_SHELL, TopAbs_SOLID

    name, pieces = entry["name"], entry["pieces"]
    solids, shells = explore(shape, TopAbs_SOLID), explore(shape, TopAbs_SHELL)
    if len(solids) != pieces or len(shells) != pieces:
        return [f"{name}: {len(solids)} solids, {len(shells)} shells, not {pieces}"]
    faults = []
    if not all(BRepCheck_Analyzer(solid).IsValid() for solid in solids):
        faults.append(f"{name} is not valid")
    if not all(BRep_Tool.IsClosed_s(shell) for shell in shells):
        faults.append(f"{name} is not closed")
    volumes = [volume_of(solid) for solid in solids]
    if min(volumes) <= 0:
        faults.append(f"{name} has a solid that is inside out: {volumes}")
    volume = sum(volumes)
    if abs(volume / entry["volume_mm3"] - 1) > FROM_OURS:
        volume = sum(map(triangulated_volume_of, solids))
    from_mesh = FROM_MESH_OF_RODS if name.endswith("_rod") else FROM_MESH
    for key, share in [("mesh_volume_mm3", from_mesh), ("volume_mm3", FROM_OURS)]:
        if abs(volume / entry[key] - 1) > share:
            faults.append(f"{name}: {volume:.3f} mm3, {key} {entry[key]}")
    return faults


def check_part(path, entry):
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID

    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_RetDone:
        return ["cannot be read"]
    reader.TransferRoots()
    shape = reader.OneShape()
    if shape.IsNull() or shape.ShapeType() != TopAbs_SOLID or entry["pieces"] != 1:
        return ["is not one solid"]
    may_be_mixed = (path.parent.parent.name, entry["name"]) in MIXED
    if entry["made"] != "exact" and not (may_be_mixed and entry["made"] == "mixed"):
        return [f"is {entry['made']}: {entry['because']}"]
    return faults_of(shape, entry)


def glb_bodies(path):
    """Name, matrix rows in mm, colour of each body, by the GLB."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    header = json.loads(data[20 : 20 + length])
    bodies = {}
    for node in header["nodes"]:
        # Wires are drawn and are no bodies.
        if "mesh" not in node or node.get("extras", {}).get("kind") == "wire":
            continue
        x, y, z, w = node.get("rotation", [0, 0, 0, 1])
        turn = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        at = [1000 * value for value in node.get("translation", [0, 0, 0])]
        material = header["materials"][header["meshes"][node["mesh"]]["primitives"][0]["material"]]
        colour = material["pbrMetallicRoughness"]["baseColorFactor"]
        bodies[node["name"]] = ([row + [shift] for row, shift in zip(turn, at)], colour)
    return bodies


def label_name(label):
    from OCP.TDataStd import TDataStd_Name

    name = TDataStd_Name()
    return name.Get().ToExtString() if label.FindAttribute(TDataStd_Name.GetID_s(), name) else None


def colours_of(colours, label, shape):
    """Colours of a part by its label, or of each of its solids; None for one without."""
    from OCP.Quantity import Quantity_Color
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.XCAFDoc import XCAFDoc_ColorSurf, XCAFDoc_ColorTool

    whole = Quantity_Color()
    if XCAFDoc_ColorTool.GetColor_s(label, XCAFDoc_ColorSurf, whole):
        return [whole]
    found = []
    for solid in explore(shape, TopAbs_SOLID):
        colour = Quantity_Color()
        found.append(colour if colours.GetColor(solid, XCAFDoc_ColorSurf, colour) else None)
    return found


def colour_faults(part, found, wanted):
    if not found or None in found:
        return [f"{part} has no colour"]
    seen = [(colour.Red(), colour.Green(), colour.Blue()) for colour in found]
    if any(abs(a - b) > COLOUR for colour in seen for a, b in zip(colour, wanted)):
        return [f"{part} has colours {seen}, not {wanted[:3]}"]
    return []


def check_frame(path, entries):
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDF import TDF_Label, TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

    document = TDocStd_Document(TCollection_ExtendedString("step"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    if reader.ReadFile(str(path)) != IFSelect_RetDone or not reader.Transfer(document):
        return ["cannot be read"]
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    free = TDF_LabelSequence()
    shapes.GetFreeShapes(free)
    if free.Length() != 1:
        return [f"{free.Length()} assemblies"]
    parts = TDF_LabelSequence()
    XCAFDoc_ShapeTool.GetComponents_s(free.Value(1), parts)
    wanted, faults, seen = glb_bodies(path.with_name("frame.glb")), [], set()
    names = []
    for at in range(1, parts.Length() + 1):
        label, original = parts.Value(at), TDF_Label()
        XCAFDoc_ShapeTool.GetReferredShape_s(label, original)
        body, part = label_name(label), label_name(original)
        names.append(body)
        if body not in wanted:
            continue
        rows, colour = wanted[body]
        move = XCAFDoc_ShapeTool.GetLocation_s(label).Transformation()
        off = max(abs(move.Value(i + 1, j + 1) - rows[i][j]) for i in range(3) for j in range(4))
        if off > PLACE_MM:
            faults.append(f"{body} is {off:.4f} beside its place")
        if part in seen:
            continue
        seen.add(part)
        shape = XCAFDoc_ShapeTool.GetShape_s(original)
        faults += colour_faults(part, colours_of(colours, original, shape), colour)
        entry = next((entry for entry in entries if entry["name"] == part), None)
        faults += faults_of(shape, entry) if entry else [f"{part} is not in the manifest"]
    if sorted(names) != sorted(wanted):
        faults.append(f"bodies differ from frame.glb: {sorted(set(names) ^ set(wanted))[:5]}")
    if len(seen) != len(entries):
        faults.append(f"{len(seen)} different solids, the manifest has {len(entries)}")
    return faults


def work(queue, check, *arguments):
    try:
        queue.put(check(*arguments))
    except Exception as error:  # whatever the reader throws is a finding
        queue.put([repr(error)])


def in_time(check, *arguments):
    """The faults that a check finds, in a process that is ended when it takes too long or dies."""
    forked = multiprocessing.get_context("fork")
    queue = forked.Queue()
    process = forked.Process(target=work, args=(queue, check, *arguments))
    process.start()
    process.join(LIMIT_S)
    if process.is_alive():
        process.kill()
        process.join()
        return [f"not read within {LIMIT_S} s"]
    return queue.get() if process.exitcode == 0 else [f"the reader died with {process.exitcode}"]


def main():
    for module in LOADED_AHEAD:
        importlib.import_module(f"OCP.{module}")
    failed, seen = False, {}
    for folder in map(Path, sys.argv[1:]):
        entries = json.loads((folder / "manifest.json").read_text())["step"]
        files = {}
        for entry in entries:
            files.setdefault(entry["file"], []).append(entry)
        on_disk = {str(path.relative_to(folder)) for path in folder.rglob("*.step")}
        if on_disk != set(files):
            print(f"FAILED STEP {folder.name}: the manifest lists other files than there are: {sorted(on_disk ^ set(files))}")
            failed = True
        for file, entries in files.items():
            if file == "frame.step":
                faults = in_time(check_frame, folder / file, entries)
            else:
                # Frames share parts: the same bytes of which the same is said.
                part = ((folder / file).read_bytes(), json.dumps(entries[0]))
                faults = seen[part] if part in seen else seen.setdefault(part, in_time(check_part, folder / file, entries[0]))
            name = f"STEP {folder.name}/{file}"
            made = entries[0]["made"] if len(entries) == 1 else f"{len(entries)} solids"
            print(f"FAILED {name}: {'; '.join(faults)}" if faults else f"ok {name} ({made})", flush=True)
            failed |= bool(faults)
    return failed


if __name__ == "__main__":
    sys.exit(main())
