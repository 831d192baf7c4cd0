"""A study on this machine, on a real HyperQueue server, and its sensitivities by SALib.

    study.py FLEXFRAME FOLDER

The server runs on the loopback with three workers. It is killed with them in the middle of a study; another server takes over. The table is then that of an undisturbed run on this machine, byte for byte. A program that was built with the feature
`parquet` has written the table as Parquet, too, which is compared with the CSV. One line a result: "ok NAME", "FAILED NAME: WHY"."""

import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import numpy
from SALib.analyze import sobol

PROGRAM, FOLDER = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
ROWS = 12
PLAN = f"""base = "cognifly"
sampling = "sobol"
samples = {ROWS}
measures = ["mass", "envelope.width"]
[vary]
arm_rod = [62, 92]
cage_rod = [172, 178]
"""
HIDDEN = """kind = "recovery"
effects = ["preload", "cubic_stiffness"]
strengths = [266]
[seeds]
nothing = [5000, 5001]
one = [500, 501]
"""
GROUPS = 8
SENSITIVITY = f"""base = "cognifly"
sampling = "saltelli"
samples = {GROUPS}
measures = ["mass"]
[vary]
arm_rod = [76, 80]
strut_rod = [47, 52]
"""
# Workers are threads of the server's process: one that is cut off takes the server with it, so none can be lost alone here.
SERVER = """
import pathlib, sys, threading
from hyperqueue.cluster import LocalCluster, WorkerConfig
cluster = LocalCluster(server_dir=sys.argv[1])
for _ in range(3):
    cluster.start_worker(WorkerConfig(cores=1))
pathlib.Path(sys.argv[2]).write_text(str(cluster.cluster.server_dir))
threading.Event().wait()
"""


def result(name, good, why=""):
    why = " ".join(str(why).split())
    print(f"ok {name}" if good else f"FAILED {name}: {why}", flush=True)


def study(*words, env=None):
    done = subprocess.run([PROGRAM, "study", *words], capture_output=True, text=True, timeout=1800, env=env)
    return done.returncode, done.stdout + done.stderr


class Server:
    """A HyperQueue server with three workers, in a process of its own."""

    def __init__(self, name):
        self.folder, ready = FOLDER / name, FOLDER / f"{name}.ready"
        self.folder.mkdir()
        self.process = subprocess.Popen([sys.executable, "-c", SERVER, self.folder, ready], stdout=subprocess.DEVNULL)
        deadline = time.monotonic() + 600
        while not ready.exists() or not ready.read_text():
            if self.process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError("the HyperQueue server does not start")
            time.sleep(0.1)
        self.directory = ready.read_text()

    def env(self):
        return {**os.environ, "HQ_SERVER_DIR": self.directory, "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"}

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def on_hyperqueue(plan, expected):
    out = FOLDER / "cluster"
    first = Server("first")
    run = [PROGRAM, "study", "run", plan, "--engine", "hq", "--block", "2", "-o", out]
    # In a group of its own, so that nothing of it outlives the server.
    waiting = subprocess.Popen(run, env=first.env(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    blocks = out / "study-plan/blocks"
    deadline = time.monotonic() + 1200
    while len(list(blocks.glob("*.jsonl"))) < 2 and time.monotonic() < deadline and waiting.poll() is None:
        time.sleep(0.05)
    first.kill()
    said = waiting.communicate(timeout=1800)[0]
    done = len(list(blocks.glob("*.jsonl")))
    result("study on HyperQueue: a killed server ends the run with exit code 3", waiting.returncode == 3, f"{waiting.returncode}: {said}")
    kept = sum(1 for line in (out / "study-plan/rows.jsonl").read_text().splitlines()) - 1
    result("study on HyperQueue: what was finished is kept", 0 < kept + done < ROWS, f"{kept} rows and {done} blocks")
    second = Server("second")
    try:
        code, said = study("run", plan, "--engine", "hq", "--block", "2", "-o", out, env=second.env())
    finally:
        second.kill()
    result("study on HyperQueue: another server goes on", code == 0, said)
    same_table(out, expected)


def without_a_server(plan):
    """What is missing is told in one sentence, and is no failure of the machine."""
    env = {**os.environ, "HQ_SERVER_DIR": str(FOLDER / "nowhere"), "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"}
    code, said = study("run", plan, "--engine", "hq", "-o", FOLDER / "alone", env=env)
    good = code == 2 and "no HyperQueue server" in said and len(said.splitlines()) == 1
    result("study on HyperQueue: without a server one sentence and exit code 2", good, f"{code}: {said}")


def same_table(out, expected):
    table = (out / "study-plan/study.csv")
    result("study on HyperQueue: the table of this machine", table.exists() and table.read_bytes() == expected, "the tables differ")
    blocks = out / "study-plan/blocks"
    result("study on HyperQueue: no file of a block is left", not blocks.exists(), str(list(blocks.glob("*")) if blocks.exists() else ""))


def as_parquet(table):
    """The Parquet table, where the program writes one: the same columns, numbers, texts and empty cells as the CSV."""
    place = table.with_suffix(".parquet")
    if not place.exists():
        return
    import pandas
    from pyarrow import parquet

    with table.open() as file:
        rows = list(csv.reader(file))
    read = parquet.read_table(place)
    result("study as Parquet: the columns of the CSV", read.column_names == rows[0], str(read.column_names))
    texts = {"refused", "law", "truth", "verdict", "named", "named.2", "named.3", "first"} | {name for name in rows[0] if name.startswith("bought.")}
    kinds = {name: "int64" if name == "row" else "string" if name in texts else "double" for name in rows[0]}
    found = {field.name: str(field.type) for field in read.schema}
    result("study as Parquet: whole numbers, numbers and texts", found == kinds, str(found))
    off = []
    for column, name in enumerate(rows[0]):
        for row, value in enumerate(read.column(name).to_pylist()):
            cell = rows[row + 1][column]
            same = value is None if cell == "" else value == cell if isinstance(value, str) else value == float(cell)
            if not same:
                off.append(f"{name} row {row}: {value!r}, not {cell!r}")
    result("study as Parquet: the cells of the CSV", read.num_rows == len(rows) - 1 and not off, "; ".join(off[:5]))
    frame = pandas.read_parquet(place)
    result("study as Parquet: pandas reads it", list(frame.columns) == rows[0] and len(frame) == len(rows) - 1, str(frame.dtypes))


def sensitivities():
    plan, out = FOLDER / "sensitivity.toml", FOLDER / "out"
    plan.write_text(SENSITIVITY)
    code, said = study("run", plan, "-o", out)
    result("study: sensitivities run", code == 0, said)
    rows = list(csv.DictReader((out / "study-sensitivity/study.csv").open()))
    figures = numpy.array([float(row["mass"]) for row in rows])
    problem = {"num_vars": 2, "names": ["arm", "strut"], "bounds": [[76, 80], [47, 52]]}
    theirs = sobol.analyze(problem, figures, calc_second_order=False, num_resamples=200, seed=1)
    code, said = study("report", plan, "-o", out, "--json")
    front = json.loads(said)["front"] if code == 0 else []
    result("study: a report of one measure has the row that is best in it", len(front) == 1, said)
    plan.write_text(SENSITIVITY.replace('["mass"]', '["mass", "mass.rods"]'))
    code, said = study("run", plan, "-o", out, "--restart")
    code, said = study("report", plan, "-o", out, "--json")
    result("study: the report is made", code == 0, said)
    ours = json.loads(said)["indices"][0]["axes"]
    for order, key in (("first", "S1"), ("total", "ST")):
        off = max(abs(axis[order]["share"] - share) for axis, share in zip(ours, theirs[key]))
        result(f"study: {order} Sobol' indices are SALib's", off < 1e-9, f"off by {off}")
        wide = max(abs(axis[order]["half_interval"] / half - 1) for axis, half in zip(ours, theirs[key + "_conf"]))
        result(f"study: intervals of the {order} indices are SALib's within a third", wide < 0.34, f"off by {wide:.2f}")


def hidden_effects():
    """Drops with something hidden in them run there as they run here."""
    plan = FOLDER / "hidden.toml"
    plan.write_text(HIDDEN)
    code, said = study("run", plan, "-o", FOLDER / "here")
    result("study of hidden effects: runs on this machine", code == 0, said)
    here = FOLDER / "here/study-hidden/study.csv"
    server = Server("third")
    try:
        code, said = study("run", plan, "--engine", "hq", "--block", "1", "-o", FOLDER / "there", env=server.env())
    finally:
        server.kill()
    there = FOLDER / "there/study-hidden/study.csv"
    same = code == 0 and there.read_bytes() == here.read_bytes()
    result("study of hidden effects: HyperQueue gives the table of this machine", same, said)
    named = [row["named"] for row in csv.DictReader(here.open())]
    result("study of hidden effects: what was hidden is named", named == ["", "cubic_stiffness", "preload"], str(named))
    as_parquet(here)


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    plan = FOLDER / "plan.toml"
    plan.write_text(PLAN)
    code, said = study("run", plan, "-o", FOLDER / "local")
    result("study: runs on this machine", code == 0, said)
    table = (FOLDER / "local/study-plan/study.csv").read_bytes()
    rows = list(csv.DictReader(table.decode().splitlines()))
    refused = [row for row in rows if row["refused"]]
    result("study: a frame that does not close is a row with its reason", len(rows) == ROWS and 0 < len(refused) < ROWS, f"{len(refused)} refused")
    as_parquet(FOLDER / "local/study-plan/study.csv")
    without_a_server(plan)
    on_hyperqueue(plan, table)
    hidden_effects()
    sensitivities()


main()
