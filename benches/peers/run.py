"""The same synthetic drops diagnosed by flexframe and by what PyPI offers. README.md says how to run it and what is fair.

    python benches/peers/run.py target/release/flexframe [--seeds 1,2,3,4] [--work DIR] [--effects ID,...] [--only names|times]

Prints a line a case (they begin with #) and then tables in markdown.
"""

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.dont_write_bytecode = True

import numpy as np

import timing
from oscillator import fit
from residual import LINEAR, Base, gaussian_process, polynomial
from sindy import named
from tables import METHODS, gap_table, name_table, time_table
from tool import Tool
from waves import distance, net_gap, read, whitening, window

HEIGHTS_M = (0.5, 1.0, 1.5)
HELD_OUT_M = 2.0
K_N_M, C_NS_M = 7040.0, 46.0
# Weak and plain: about 100 and about 900 in squared whitened distance between the noise-free mean waves and the linear model
# that is refitted to them, at k = 7040 N/m and c = 46 N s/m. Kinks are on none of the places that SINDy's library has.
CASES = {
    "cubic_stiffness": [{"k3": 1.5e6}, {"k3": 6e6}],
    "bilinear_stiffness": [{"x1_mm": 8.0, "k_bl": 550.0}, {"x1_mm": 6.0, "k_bl": 2.4e3}],
    "hunt_crossley_damping": [{"chi": 380.0}, {"chi": 1.35e3}],
    "coulomb_friction": [{"f_c_n": 2.8}, {"f_c_n": 8.0}],
    "quadratic_damping": [{"c2": 2.0}, {"c2": 8.5}],
    "preload": [{"f0_n": 2.1}, {"f0_n": 7.0}],
    "bottoming": [{"x_b_mm": 9.0, "k_b": 9e3, "lambda": 0.3}, {"x_b_mm": 11.0, "k_b": 6e4, "lambda": 0.3}],
}


def case(tool, work, effect, strength, seed):
    """One set of drops, by everybody."""
    own = 1000 * seed + 10 * list(CASES).index(effect) + strength  # no two sets share their trial variation
    rng = np.random.default_rng(own)
    k, c = K_N_M * rng.uniform(0.8, 1.25), C_NS_M * rng.uniform(0.8, 1.25)
    name = f"{effect}-{strength}-{seed}"
    folder = tool.synthesize(work, name, k, c, effect, CASES[effect][strength], (*HEIGHTS_M, HELD_OUT_M), own)
    diagnosis, model, tool_s = tool.diagnose(folder / "drops", HELD_OUT_M, Path(work) / f"out-{name}")
    truth = window(tool.wave(folder / "truth" / "model.toml", HELD_OUT_M, work))

    groups = read(folder / "drops" / "drops.csv")
    held_out = groups.pop()
    seconds = {"flexframe": tool_s}

    def timed(name, work):
        begin = time.process_time()
        result = work()
        seconds[name] = time.process_time() - begin
        return result

    base = Base(timed("linear fit", lambda: fit(LINEAR, groups, whitening(groups)).x))
    before = base.window(HELD_OUT_M)
    after = {
        "flexframe": window(tool.wave(model, HELD_OUT_M, work)),
        "Gaussian process": timed("Gaussian process", lambda: gaussian_process(groups, base, HELD_OUT_M)),
        "polynomial": timed("polynomial", lambda: polynomial(groups, base, HELD_OUT_M)),
    }
    net = {name: net_gap(held_out.mean, held_out.error, wave) for name, wave in (after | {"before": before}).items()}
    gap = diagnosis["gap"]
    names = {
        "flexframe": diagnosis["effects"][0]["id"] if diagnosis["verdict"] != "nothing_missing" else None,
        "SINDy": timed("SINDy", lambda: named(groups)),
        "SINDy, filter left in": named(groups, undo_filter=False),
    }
    return {
        "effect": effect,
        "strength": strength,
        "excess": diagnosis["base_lack_of_fit"]["sum_of_squares"]["value"] - (31 * len(HEIGHTS_M) - 2),
        "names": names,
        "verdict": diagnosis["verdict"],
        "before": distance(truth, before),
        "clean": {name: distance(truth, wave) / distance(truth, before) for name, wave in after.items()},
        "measured": {name: net[name] / net["before"] if net["before"] > 0 else np.nan for name in after},
        "reported": gap["held_out_after"] / gap["held_out_before"] if gap["held_out_before"] > 0 else np.nan,
        "seconds": seconds,
    }


def line(one):
    said = ", ".join(f"{who}: {name or 'nothing'}" for who, name in one["names"].items())
    ratios = ", ".join(f"{name} {one['clean'][name]:.2f} ({one['measured'][name]:.2f})" for name in METHODS)
    place = f"# {one['effect']} {('weak', 'plain')[one['strength']]}, excess {one['excess']:.0f}, held-out gap {one['before']:.2f} g"
    return f"{place}: {one['verdict']}; {said}; {ratios}; reported ({one['reported']:.2f})"


def main():
    parser = argparse.ArgumentParser(description="The same synthetic drops diagnosed by flexframe and by what PyPI offers.")
    parser.add_argument("binary", help="the flexframe program")
    parser.add_argument("--seeds", default="1,2,3,4", help="seeds, separated by commas (default 1,2,3,4)")
    parser.add_argument("--effects", default=",".join(CASES), help="effects of the synthetic drops (default: all seven)")
    parser.add_argument("--only", choices=["names", "times"], help="one half of the work")
    parser.add_argument("--work", help="folder for synthetic drops and results (default: a temporary one)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = Path(options.work or temporary)
        work.mkdir(parents=True, exist_ok=True)
        tool = Tool(options.binary)
        if options.only != "times":
            cases = []
            for effect in options.effects.split(","):
                for strength in range(len(CASES[effect])):
                    for seed in options.seeds.split(","):
                        cases.append(case(tool, work, effect, strength, int(seed)))
                        print(line(cases[-1]), flush=True)
            name_table(cases)
            gap_table(cases)
        if options.only != "names":
            time_table(timing.rows(tool, work, HEIGHTS_M))


if __name__ == "__main__":
    main()
