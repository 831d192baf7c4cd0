"""check_manifest.py MANIFEST.json...: one line a printed part, one a file.

Reads back what a build says it wrote: each file's SHA-256, and for each part's STL that trimesh finds it
closed and of the stated box, volume and number of triangles, and that manifold3d takes it as it is and
finds the same volume, which self-intersections or doubled walls would change.
"""

import hashlib
import json
import sys
from pathlib import Path

import manifold3d
import numpy
import trimesh

LENGTH_MM = 1e-3
VOLUME_RATIO = 1e-4


def main(manifests):
    # Presets share most of their parts: each is looked at once.
    known = {}
    for path in map(Path, manifests):
        manifest = json.loads(path.read_text())
        frame = path.parent.name
        for file in manifest["files"]:
            report(f"sha256 {frame}/{file['path']}", hash_differs(path.parent, file))
        for part in manifest["parts"]:
            stl = next(file for file in part["files"] if file.endswith(".stl"))
            stated = {key: value for key, value in part.items() if key != "files"}
            same = ((path.parent / stl).read_bytes(), json.dumps(stated, sort_keys=True))
            if same not in known:
                known[same] = part_differs(path.parent / stl, part)
            report(f"trimesh {frame}/{part['name']}", known[same])


def report(name, why):
    print(f"FAILED {name}: {why}" if why else f"ok {name}", flush=True)


def hash_differs(folder, file):
    found = hashlib.sha256((folder / file["path"]).read_bytes()).hexdigest()
    return None if found == file["sha256"] else f"is {found}"


def part_differs(stl, part):
    mesh = trimesh.load(stl, file_type="stl")
    if not (mesh.is_watertight and mesh.is_winding_consistent):
        return "not closed"
    if len(mesh.faces) != part["triangles"]:
        return f"{len(mesh.faces)} triangles, stated {part['triangles']}"
    if numpy.abs(mesh.extents - part["bbox_mm"]).max() > LENGTH_MM:
        return f"box {mesh.extents.round(4).tolist()} mm, stated {part['bbox_mm']}"
    if differs(mesh.volume, part["volume_mm3"]):
        return f"volume {mesh.volume:.3f} mm3, stated {part['volume_mm3']:.3f}"
    solid = manifold3d.Manifold(
        manifold3d.Mesh(mesh.vertices.astype(numpy.float32), mesh.faces.astype(numpy.uint32))
    )
    if solid.status() != manifold3d.Error.NoError:
        return f"manifold3d: {solid.status().name}"
    united = manifold3d.Manifold.batch_boolean([solid, solid], manifold3d.OpType.Add)
    if differs(united.volume(), part["volume_mm3"]):
        return f"manifold3d: volume of the union with itself {united.volume():.3f} mm3"
    return None


def differs(found, stated):
    return abs(found - stated) > VOLUME_RATIO * stated


if __name__ == "__main__":
    main(sys.argv[1:])
