"""Processor time of a wave and of a refit, SciPy beside the tool, on the same drops."""

import time
from dataclasses import dataclass

import numpy as np

from oscillator import EFFECTS, fit, wave
from waves import read, whitening

TRACE_S = 0.06
WAVES = 20
REFITS = 5
TOOL_REFITS = (20, 520)
# Drops that hold the effect, so that a fit of it ends inside its bounds.
TRUTHS = {
    "linear": {},
    "cubic_stiffness": {"k3": 5e6},
    "coulomb_friction": {"f_c_n": 15.0},
    "maxwell_branch": {"k_m": 8e3, "tau_ms": 3.0},
}


def wave_seconds(effect, values, method):
    """One drop of 60 ms from 1.5 m, put out every 0.05 ms, as `cargo bench --bench drop` times it."""
    begin = time.process_time()
    for _ in range(WAVES):
        wave(effect, values, 1.5, TRACE_S, method)
    return (time.process_time() - begin) / WAVES


def refit_seconds(effect, groups, whites):
    """One refit to resampled drops, begun where all drops ended, the whitening kept: what `fit --bootstrap` repeats."""
    best = fit(effect, groups, whites).x
    rng = np.random.default_rng(1)
    begin = time.process_time()
    evaluations = 0
    for _ in range(REFITS):
        done = fit(effect, [group.resampled(rng) for group in groups], whites, best)
        evaluations += done.evaluations
    return (time.process_time() - begin) / REFITS, evaluations / REFITS, best


@dataclass
class Row:
    """A model's times."""

    id: str
    apart_g: float  # largest distance between SciPy's wave and the tool's
    rk45_s: float
    lsoda_s: float
    residuals: float  # evaluations of all heights a refit
    refit_s: float
    tool_s: float


def rows(tool, work, heights_m):
    """A row an effect."""
    table = []
    for effect in EFFECTS:
        truth = TRUTHS[effect.id]
        values = (6800.0, 44.0, *truth.values())
        id = None if effect.id == "linear" else effect.id
        folder = tool.synthesize(work, f"time-{effect.id}", *values[:2], id, truth, heights_m, 5)
        truth = folder / "truth" / "model.toml"
        ours = wave(effect, values, 1.5, TRACE_S)
        apart_g = np.abs(ours - tool.wave(truth, 1.5, work)[: len(ours)]).max()
        groups = read(folder / "drops" / "drops.csv")
        refit_s, residuals, best = refit_seconds(effect, groups, whitening(groups))
        tool_s = tool.refit_seconds(folder / "drops", truth, ("k", "c", *effect.keys), TOOL_REFITS, work)
        waves_s = [wave_seconds(effect, values, method) for method in ("RK45", "LSODA")]
        table.append(Row(effect.id, apart_g, *waves_s, residuals, refit_s, tool_s))
        print(f"# {effect.id}: SciPy ends at {np.round(best, 3)}, truth {values}", flush=True)
    return table
