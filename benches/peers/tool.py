"""flexframe as a program: what it synthesizes, names and draws, and the processor time it takes."""

import json
import os
import resource
import subprocess
from pathlib import Path

import numpy as np

ONE_THREAD = {**os.environ, "RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
PLAN = """mass_kg = 0.241
gap_mm = 16.0
[sensor]
cutoff_hz = 79.57747154594767
order = 1
limit_g = 230.0
channel = "axial"
[effects.linear_spring]
k = {k}
[effects.linear_damper]
c = {c}
{effect}
[drops]
heights_m = {heights}
count = 20
seed = 1
[scatter]
share = 0.1
correlation_ms = 1.5
[logger]
noise_g = 0.17
counts_per_g = 8.877
rate_hz = 1000.0
"""


class Tool:
    """One binary."""

    def __init__(self, binary):
        self.binary = str(binary)

    def run(self, *arguments):
        """What it prints, and its processor seconds. 1 says that something is missing."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.binary, *map(str, arguments)], capture_output=True, text=True, env=ONE_THREAD)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode not in (0, 1):
            raise SystemExit(f"{arguments}: {done.stderr.strip()}")
        return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def synthesize(self, folder, name, k, c, effect, values, heights_m, seed):
        """A folder with drops and truth."""
        table = "\n".join([f"[effects.{effect}]", *(f"{key} = {float(value)!r}" for key, value in values.items())]) if effect else ""
        plan = Path(folder) / f"{name}.toml"
        plan.write_text(PLAN.format(k=float(k), c=float(c), effect=table, heights=list(heights_m)))
        self.run("synthesize", plan, "--seed", seed, "-o", folder, "-q")
        return Path(folder) / f"synthesize-{name}"

    def diagnose(self, drops, held_out_m, out):
        """Its JSON, its model file, and its processor seconds."""
        text, seconds = self.run("diagnose", drops, "--model", "paper", "--hold-out-heights", held_out_m, "-o", out, "--json")
        return json.loads(text), Path(out) / "diagnose-paper" / "model.toml", seconds

    def wave(self, model, height_m, out):
        """A model's reading every 0.05 ms from first touch on, g."""
        text, _ = self.run("drop", "--model", model, "--height", height_m, "--trace", "--json", "-o", out)
        return np.array(json.loads(text)["heights"][0]["accel_g"])

    def refit_seconds(self, drops, model, keys, counts, out):
        """Processor time of one resampled refit: the slope between two numbers of them, so that start, reading, the first
        fit and plots cancel."""
        times = []
        for count in counts:
            arguments = ("--model", model, "--free", ",".join(keys), "--objective", "ml", "--bootstrap", count)
            times.append(self.run("fit", drops, *arguments, "-o", out, "--json")[1])
        return (times[1] - times[0]) / (counts[1] - counts[0])
