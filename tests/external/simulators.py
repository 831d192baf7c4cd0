"""simulators.py BINARY FOLDER: real engines read what `flexframe export` writes. One line a check: "ok NAME" or "FAILED NAME: WHY".

MuJoCo loads the MJCF, PyBullet the URDF and Drake's parser the SDF of every preset; mass, centre of mass and inertia are those of the mass
table (`check --json`) within 0.1 %, turned into the simulator's axes here a second time. In MuJoCo a frame hovers, turns about its axis
without roll, stands on its legs as deep as its weight over their stiffness, and falls as `drop --model paper` says. Files with a planted
fault must fail the same checks.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pybullet as p
import trimesh
from pydrake.geometry import Role
from pydrake.math import RigidTransform
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
from pydrake.systems.framework import DiagramBuilder

GRAVITY = 9.81
# Shares of a mass or an inertia, of a peak, of a depth.
OF_TABLE, OF_PEAK, OF_DEPTH = 0.001, 0.05, 0.01
DRIFT_M, ROLL_DEG = 0.001, 0.1
HEIGHTS_M = [0.3, 0.5, 1.0, 1.5]
# Front is x and left is y, the design has right x and front y: one row an axis.
AXES = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])

SHAPES, QUADRANTS = ["cage", "hub", "sleeve"], ["FR", "FL", "BL", "BR"]

BINARY, WORK = sys.argv[1], Path(sys.argv[2])
FAILED = []


def told(name, faults):
    print(f"FAILED {name}: {'; '.join(faults)}" if faults else f"ok {name}", flush=True)
    if faults:
        FAILED.append(name)


def flexframe(*arguments):
    run = subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True)
    # 1 is a limit that is violated: that of the real frame's width, for one.
    assert run.returncode in (0, 1), run.stderr
    return run.stdout


def table_of(frame):
    """Mass, centre and inertia about it, SI, in the simulator's axes, by the mass table."""
    masses = json.loads(flexframe("check", frame, "--json"))["frames"][0]["masses"]
    centre = AXES @ np.array(masses["centre_of_mass_mm"]) * 1e-3
    return masses["total_g"] * 1e-3, centre, AXES @ np.array(masses["inertia_g_mm2"]) @ AXES.T * 1e-9


def exported(frame, *options):
    name = flexframe("export", frame, "-o", WORK, "--quiet", *options) or Path(frame).stem
    return WORK / f"{name}-simulators"


def off_the_table(table, mass, centre, inertia):
    faults = []
    if abs(mass / table[0] - 1) > OF_TABLE:
        faults.append(f"{mass} kg, the table has {table[0]}")
    # A thousandth of the frame's size of 0.1 m.
    if np.abs(centre - table[1]).max() > OF_TABLE * 0.1:
        faults.append(f"centre at {centre}, the table has {table[1]}")
    if np.abs(inertia - table[2]).max() > OF_TABLE * np.abs(table[2]).min(initial=np.inf, where=np.eye(3, dtype=bool)):
        faults.append(f"inertia {inertia.tolist()}, the table has {table[2].tolist()}")
    return faults


def together(bodies):
    """Mass, centre and inertia of bodies, each a mass, a centre, and a tensor about it."""
    mass = sum(m for m, _, _ in bodies)
    centre = sum(m * c for m, c, _ in bodies) / mass
    about = [i + m * ((c - centre) @ (c - centre) * np.eye(3) - np.outer(c - centre, c - centre)) for m, c, i in bodies]
    return mass, centre, sum(about)


# --- MuJoCo ------------------------------------------------------------------------------------------------


def loaded(folder):
    model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    return model, mujoco.MjData(model)


def mujoco_masses(folder):
    """By the engine's own mass matrix: its blocks are the mass and the inertia about the body's origin."""
    model, data = loaded(folder)
    mujoco.mj_forward(model, data)
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    body = model.body("frame").id
    centre = data.subtree_com[body] - data.xpos[body]
    mass = full[0, 0]
    return mass, centre, full[3:, 3:] - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))


def angles_deg(quaternion):
    w, x, y, z = quaternion
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    yaw = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.degrees([roll, pitch, yaw])


def flown(folder, thrusts, seconds):
    """Drift of the centre of mass, m, and roll, pitch and yaw, degrees, after a flight from rest."""
    model, data = loaded(folder)
    mujoco.mj_resetDataKeyframe(model, data, model.key("hover").id)
    data.ctrl[:] = thrusts(model, data.ctrl.copy())
    mujoco.mj_forward(model, data)
    body = model.body("frame").id
    start = data.subtree_com[body].copy()
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    return np.linalg.norm(data.subtree_com[body] - start), angles_deg(data.qpos[3:7])


def hover_faults(folder, thrusts=lambda _, hover: hover):
    drift, angles = flown(folder, thrusts, 1.0)
    faults = [f"drifts {1e3 * drift:.3f} mm in 1 s"] if drift > DRIFT_M else []
    return faults + ([f"turns by {angles} degrees"] if np.abs(angles).max() > ROLL_DEG else [])


def equal(model, hover):
    return np.full_like(hover, hover.sum() / 4)


def yaw_faults(folder, table):
    """5 % more thrust of the motors that turn clockwise: the frame turns against the clock."""
    told_of = json.loads((folder / "simulator.json").read_text())
    clockwise = {f"motor_{m['number']}": m["spin"] == "clockwise" for m in told_of["motors"]}
    ratio = told_of["motors"][0]["torque_over_thrust_m"]
    share, seconds = 0.05, 0.5

    def thrusts(model, hover):
        signs = np.array([1 if clockwise[model.actuator(i).name] else -1 for i in range(model.nu)])
        # As large for all four: what is added turns the frame about no other axis.
        return hover + signs * share * hover.mean()

    _, [roll, pitch, yaw] = flown(folder, thrusts, seconds)
    expected = math.degrees(0.5 * share * table[0] * GRAVITY * ratio / table[2][2, 2] * seconds**2)
    faults = [f"rolls by {roll:.3f}, pitches by {pitch:.3f} degrees"] if max(abs(roll), abs(pitch)) > ROLL_DEG else []
    return faults + ([f"yaws by {yaw:.3f} degrees, not by {expected:.3f}"] if abs(yaw / expected - 1) > 0.01 else [])


def touching(model, data):
    """What of the frame touches the floor."""
    names = set()
    for contact in data.contact[: data.ncon]:
        names |= {model.geom(int(g)).name for g in contact.geom}
    return names - {"floor"}


def fallen(folder, height_m, feet_only):
    """Largest reading of the accelerometer's axis, g; largest compression, m; what touched the floor."""
    model, data = loaded(folder)
    if feet_only:
        # `drop` knows no second body under the frame: the gap adds no force there.
        for name in SHAPES:
            model.geom(name).contype, model.geom(name).conaffinity = 0, 0
    mujoco.mj_forward(model, data)
    standing = data.qpos[2]
    data.qpos[2] += height_m
    peak, deepest, touched = 0.0, 0.0, set()
    for _ in range(round((math.sqrt(2 * height_m / GRAVITY) + 0.03) / model.opt.timestep)):
        mujoco.mj_step(model, data)
        peak = max(peak, data.sensor("imu_accelerometer").data[2] / GRAVITY)
        deepest = max(deepest, standing - data.qpos[2])
        touched |= touching(model, data)
    return peak, deepest, touched


def drop_faults(folder, drops):
    faults = []
    for drop in drops:
        peak, deepest, _ = fallen(folder, drop["height_m"], True)
        if abs(peak / drop["peak_proper_g"] - 1) > OF_PEAK:
            faults.append(f"{drop['height_m']} m: peak of {peak:.2f} g, drop has {drop['peak_proper_g']:.2f}")
        if abs(deepest * 1e3 / drop["max_displacement_mm"] - 1) > OF_PEAK:
            faults.append(f"{drop['height_m']} m: {1e3 * deepest:.2f} mm deep, drop has {drop['max_displacement_mm']:.2f}")
    return faults


def sleeve_faults(folder, drop, gap_mm):
    """Where the feet give more than the gap, sleeve and cage touch and stop the frame before the feet would; elsewhere they do nothing."""
    height_m, hits = drop["height_m"], drop["max_displacement_mm"] > gap_mm
    _, deepest, touched = fallen(folder, height_m, False)
    _, alone, _ = fallen(folder, height_m, True)
    right = {"sleeve", "cage"} <= touched and gap_mm < 1e3 * deepest < 0.95e3 * alone if hits else deepest == alone and not touched & {"sleeve", "cage"}
    faults = [] if right else [f"{sorted(touched)} touch, {1e3 * deepest:.2f} mm deep, {1e3 * alone:.2f} on the feet alone, gap {gap_mm:.1f}"]
    return f"from {height_m} m the sleeve {'hits' if hits else 'is clear of'} the floor", faults


def standing_faults(folder, table):
    model, data = loaded(folder)
    mujoco.mj_forward(model, data)
    height = data.qpos[2]
    for _ in range(round(1.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
    stiffness = json.loads((folder / "simulator.json").read_text())["legs"]["stiffness_n_m"]
    depth, expected = height - data.qpos[2], table[0] * GRAVITY / stiffness
    faults = [f"stands {1e3 * depth:.4f} mm deep, not {1e3 * expected:.4f}"] if abs(depth / expected - 1) > OF_DEPTH else []
    feet = touching(model, data)
    return faults + ([f"stands on {sorted(feet)}"] if feet != {f"foot_{q}" for q in QUADRANTS} else [])


# --- PyBullet, Drake, trimesh ------------------------------------------------------------------------------


def bullet_faults(folder, table):
    client = p.connect(p.DIRECT)
    try:
        p.setGravity(0, 0, -GRAVITY)
        p.setTimeStep(0.001)
        body = p.loadURDF(str(folder / "frame.urdf"), [0, 0, 1], flags=p.URDF_USE_INERTIA_FROM_FILE)
        links = {p.getJointInfo(body, i)[12].decode(): i for i in range(p.getNumJoints(body))}
        faults = [] if "imu_link" in links else ["has no imu_link"]
        bodies, origin = [], None
        for link in [-1, *links.values()]:
            info = p.getDynamicsInfo(body, link)
            at, turn = p.getBasePositionAndOrientation(body) if link == -1 else p.getLinkState(body, link, computeForwardKinematics=True)[:2]
            if link == -1:
                # Where the link's own origin is: the engine holds the base by its centre of mass.
                origin = np.array(p.multiplyTransforms(at, turn, *p.invertTransform(info[3], info[4]))[0])
            turn = np.array(p.getMatrixFromQuaternion(turn)).reshape(3, 3)
            bodies.append((info[0], np.array(at) - origin, turn @ np.diag(info[2]) @ turn.T))
            p.changeDynamics(body, link, linearDamping=0, angularDamping=0)
        faults += off_the_table(table, *together(bodies))
        motors = json.loads((folder / "simulator.json").read_text())["motors"]
        start = np.array(p.getBasePositionAndOrientation(body)[0])
        for _ in range(1000):
            for motor in motors:
                p.applyExternalForce(body, links[motor["name"]], [0, 0, motor["hover_thrust_n"]], [0, 0, 0], p.LINK_FRAME)
            p.stepSimulation()
        drift = np.linalg.norm(np.array(p.getBasePositionAndOrientation(body)[0]) - start)
        return faults + ([f"drifts {1e3 * drift:.3f} mm in 1 s"] if drift > DRIFT_M else [])
    finally:
        p.disconnect(client)


def drake_faults(folder, table):
    # With a scene, or the meshes are not opened.
    plant, scene = AddMultibodyPlantSceneGraph(DiagramBuilder(), 0.001)
    [instance] = Parser(plant).AddModels(str(folder / "model.sdf"))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    base = plant.GetBodyByName("base_link", instance)
    plant.SetFreeBodyPose(context, base, RigidTransform())
    whole = plant.CalcSpatialInertia(context, base.body_frame(), plant.GetBodyIndices(instance))
    centre = whole.get_com()
    inertia = whole.Shift(centre).CalcRotationalInertia().CopyToFullMatrix3()
    joints = [plant.get_joint(i).name() for i in plant.GetJointIndices(instance)]
    motors = [f"motor_{q}_joint" for q in QUADRANTS]
    faults = [] if all(motor in joints for motor in motors) else [f"joints {joints}"]
    inspector = scene.model_inspector()
    contacts = [inspector.GetName(g).split("::")[-1] for g in inspector.GetAllGeometryIds(Role.kProximity)]
    expected = [*(f"{shape}_collision" for shape in SHAPES), *(f"foot_{q}" for q in QUADRANTS)]
    faults += [] if sorted(contacts) == sorted(expected) else [f"contact shapes {contacts}"]
    return faults + off_the_table(table, whole.get_mass(), centre, inertia)


def mesh_faults(folder):
    faults = []
    for shape in SHAPES:
        mesh = trimesh.load(folder / "meshes" / f"{shape}.obj", process=False)
        if not (mesh.is_watertight and mesh.volume > 0):
            faults.append(f"{shape} is not closed")
        # Corners are rounded to the grid of STL: facets of a plane may lean by as little as that.
        elif mesh.volume < 0.99999 * mesh.convex_hull.volume:
            faults.append(f"{shape} is not convex")
    return faults


# --- all of it ---------------------------------------------------------------------------------------------


def check_preset(frame):
    folder, table = exported(frame), table_of(frame)
    told(f"{frame}: MuJoCo has the table's mass and inertia", off_the_table(table, *mujoco_masses(folder)))
    told(f"{frame}: hovers in MuJoCo", hover_faults(folder))
    told(f"{frame}: yaws in MuJoCo without roll", yaw_faults(folder, table))
    told(f"{frame}: stands on its legs in MuJoCo", standing_faults(folder, table))
    told(f"{frame}: PyBullet reads the URDF, with the table's mass and inertia, and it hovers", bullet_faults(folder, table))
    told(f"{frame}: contact shapes are closed and convex", mesh_faults(folder))
    told(f"{frame}: Drake reads the SDF, with the table's mass and inertia", drake_faults(folder, table))


def check_equal_thrusts():
    """A frame whose centre of mass is on its axis hovers with equal thrusts: cognifly with its wiring moved there."""
    masses = json.loads(flexframe("check", "cognifly", "--json"))["frames"][0]["masses"]
    wiring = next(line["total_g"] for line in masses["lines"] if line["name"] == "wiring")
    x, y = (-masses["total_g"] * at / wiring for at in masses["centre_of_mass_mm"][:2])
    file = WORK / "centred.toml"
    file.write_text(f'base = "cognifly"\nextras.wiring.position_mm = [{x}, {y}, -12.0]\n')
    told("equal thrusts hover where the centre of mass is on the axis", hover_faults(exported(file, "--mjcf"), equal))
    # Where it is not, they must not: 0.4 mm of lever tilt the frame.
    beside = hover_faults(exported("cognifly", "--mjcf"), equal)
    told("planted: equal thrusts tilt a frame with its centre of mass beside the axis", [] if beside else ["it does not tilt"])


def check_drops():
    folder, table = exported("cognifly-v8", "--model", "paper"), table_of("cognifly-v8")
    heights = ",".join(map(str, HEIGHTS_M))
    drops = json.loads(flexframe("drop", "cognifly-v8", "--model", "paper", "--height", heights, "--json", "-o", WORK))["heights"]
    told(f"MuJoCo falls from {heights} m as drop --model paper", drop_faults(folder, drops))
    told("the paper's legs carry the frame", standing_faults(folder, table))
    gap_mm = json.loads(flexframe("drop", "cognifly-v8", "--json", "-o", WORK))["body"]["gap_mm"]
    for drop in drops:
        told(*sleeve_faults(folder, drop, gap_mm))
    planted(folder, table, drops)


def planted(folder, table, drops):
    """Each check fails on a file with a fault."""
    whole = (folder / "frame.xml").read_text()
    spring = whole.split('solref="-')[1].split('"')[0]
    stiffness, damping = spring.split(" -")
    faults = {
        "2 g more": (lambda: off_the_table(table, *mujoco_masses(folder)), '<inertial pos="0 0 0" mass="0.001"', '<inertial pos="0 0 0" mass="0.0015"'),
        "x and y exchanged": (lambda: off_the_table(table, *mujoco_masses(folder)), *exchanged(whole)),
        "a motor that turns the other way": (lambda: yaw_faults(folder, table), "0 0 -0.00762", "0 0 0.00762"),
        "a motor out of its place": (lambda: hover_faults(folder), 'name="motor_FR" pos="0.0478', 'name="motor_FR" pos="0.0488'),
        "softer legs": (lambda: standing_faults(folder, table), f"-{stiffness} ", f"-{0.97 * float(stiffness)} "),
        "less damping": (lambda: drop_faults(folder, drops), f"-{damping}", f"-{0.9 * float(damping)}"),
        "another impedance": (lambda: drop_faults(folder, drops), 'solimp="0.0001 0.0001 0.001"', ""),
    }
    for name, (check, before, after) in faults.items():
        assert before in whole, (name, before)
        (folder / "frame.xml").write_text(whole.replace(before, after))
        told(f"planted: {name}", [] if check() else ["nothing is found"])
    (folder / "frame.xml").write_text(whole)


def exchanged(whole):
    before = whole.split('fullinertia="')[1].split('"')[0]
    x, y, *rest = before.split()
    return before, " ".join([y, x, *rest])


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    for frame in sorted(path.stem for path in Path("params/frames").glob("*.toml")):
        check_preset(frame)
    check_equal_thrusts()
    check_drops()
    return bool(FAILED)


if __name__ == "__main__":
    sys.exit(main())
