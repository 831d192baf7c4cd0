"""random_frames.py FOLDER [UNIONS]: one line a frame.

Looks at the STL files that tests/frame/random_builds.rs writes below FOLDER, a folder a frame: trimesh finds each closed, with
facets turned one way and a positive volume; manifold3d takes it as it is, and its union with itself has the same volume, which
self-intersections or doubled walls would change. The union takes nine tenths of the time: of many frames, one in UNIONS has it
(each, unless it is given). A part that is folded as it is printed is read once.
"""

import sys
from pathlib import Path

import manifold3d
import numpy
import trimesh

VOLUME_RATIO = 1e-4


def main(folder, unions=1):
    frames = sorted(path for path in Path(folder).iterdir() if path.is_dir())
    wrong = sum(report(frame, at % int(unions) == 0) for at, frame in enumerate(frames))
    print(f"{len(frames)} frames, {wrong} of them not sound", flush=True)
    if wrong or not frames:
        sys.exit(1)


def report(frame, united):
    shapes = {stl.read_bytes(): stl for stl in sorted(frame.glob("*.stl"), reverse=True)}
    faults = [f"{stl.name}: {why}" for stl in shapes.values() if (why := fault(stl, united))]
    if not shapes:
        faults = ["no parts"]
    print(f"FAILED random frame {frame.name}: {'; '.join(faults)}" if faults else f"ok random frame {frame.name}", flush=True)
    return bool(faults)


def fault(stl, united):
    mesh = trimesh.load(stl, file_type="stl")
    if not (mesh.is_watertight and mesh.is_winding_consistent):
        return "not closed"
    if not mesh.volume > 0:
        return f"volume {mesh.volume:.3f} mm3"
    solid = manifold3d.Manifold(manifold3d.Mesh(mesh.vertices.astype(numpy.float32), mesh.faces.astype(numpy.uint32)))
    if solid.status() != manifold3d.Error.NoError:
        return f"manifold3d: {solid.status().name}"
    volume = manifold3d.Manifold.batch_boolean([solid, solid], manifold3d.OpType.Add).volume() if united else solid.volume()
    if abs(volume / mesh.volume - 1) > VOLUME_RATIO:
        return f"manifold3d: volume {volume:.3f} mm3{' of the union with itself' if united else ''}, trimesh: {mesh.volume:.3f}"
    return None


if __name__ == "__main__":
    main(*sys.argv[1:])
