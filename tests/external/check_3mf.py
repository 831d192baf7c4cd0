"""check_3mf.py FOLDER...: one line a plate, one a frame.

Reads every plate of a built frame with the 3MF Consortium's own library: strict, so that a warning is a failure; every object
has a name, a colour and a closed mesh of the volume that the manifest states; every copy stands on the bed; and all plates
together hold as many of each part as the frame needs.
"""

import json
import sys
from collections import Counter
from pathlib import Path

import lib3mf
import numpy

VOLUME_RATIO = 1e-3


def main(folders):
    wrapper = lib3mf.get_wrapper()
    for folder in map(Path, folders):
        manifest = json.loads((folder / "manifest.json").read_text())
        volumes = {part["name"]: part["volume_mm3"] for part in manifest["parts"]}
        found = Counter()
        for plate in sorted((folder / "plates").glob("*.3mf")):
            report(f"lib3mf {folder.name}/{plate.name}", plate_fault(wrapper, plate, volumes, found))
        wanted = {part["name"]: part["quantity"] for part in manifest["parts"]}
        report(f"plates of {folder.name}", None if found == wanted else f"hold {dict(found)}, not {wanted}")


def report(name, why):
    print(f"FAILED {name}: {why}" if why else f"ok {name}", flush=True)


def plate_fault(wrapper, path, volumes, found):
    model = wrapper.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    if reader.GetWarningCount():
        return reader.GetWarning(0)
    if model.GetUnit() != lib3mf.ModelUnit.MilliMeter:
        return "is not in millimetres"
    if not model.HasPackageThumbnailAttachment():
        return "has no thumbnail"
    objects = model.GetMeshObjects()
    while objects.MoveNext():
        fault = object_fault(objects.GetCurrentMeshObject(), volumes)
        if fault:
            return fault
    items = model.GetBuildItems()
    while items.MoveNext():
        item = items.GetCurrent()
        found[item.GetObjectResource().GetName()] += 1
        fault = item_fault(model, item)
        if fault:
            return fault
    return None


def object_fault(mesh, volumes):
    name = mesh.GetName()
    if name not in volumes:
        return f"{name} is no part of the frame"
    if not mesh.IsManifoldAndOriented():
        return f"{name} is not closed"
    _, _, coloured = mesh.GetObjectLevelProperty()
    if not coloured:
        return f"{name} has no colour"
    points = vertices(mesh)
    corners = points[numpy.array([triangle.Indices[:] for triangle in mesh.GetTriangleIndices()])]
    volume = numpy.einsum("ij,ij->i", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2])).sum() / 6
    if abs(volume / volumes[name] - 1) > VOLUME_RATIO:
        return f"{name} holds {volume:.1f} mm3, not {volumes[name]:.1f}"
    return None


def vertices(mesh):
    return numpy.array([vertex.Coordinates[:] for vertex in mesh.GetVertices()])


def item_fault(model, item):
    fields = numpy.array([row[:] for row in item.GetObjectTransform().Fields])
    copy = model.GetComponentsObjectByID(item.GetObjectResourceID())
    if copy.GetComponentCount() != 1:
        return f"{copy.GetName()} is made of {copy.GetComponentCount()} meshes"
    mesh = model.GetMeshObjectByID(copy.GetComponent(0).GetObjectResourceID())
    if mesh.GetName() != copy.GetName():
        return f"a copy called {copy.GetName()} is one of {mesh.GetName()}"
    placed = vertices(mesh) @ fields[:3] + fields[3]
    lowest = placed[:, 2].min()
    return None if abs(lowest) < 1e-3 else f"{mesh.GetName()} stands at {lowest:.3f} mm"


main(sys.argv[1:])
