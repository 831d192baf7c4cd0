"""What run.py prints in the end, in markdown."""

import numpy as np

METHODS = ("flexframe", "Gaussian process", "polynomial")
# Published in docs/decisions/0010-integrator.md, base model, from `cargo bench --bench drop`.
TOOL_WAVE_S = 50e-6


def middle(values):
    known = [value for value in values if not np.isnan(value)]
    return np.median(known) if known else np.nan


def row(*cells):
    print("|", " | ".join(str(cell) for cell in cells), "|")


def rule(columns):
    print("|" + "---|" * columns)


def name_table(cases):
    """How often the first name is the true one."""
    whos = list(cases[0]["names"])

    def right(some):
        return [f"{sum(one['names'][who] == one['effect'] for one in some)}/{len(some)}" for who in whos]

    print()
    row("hidden effect", "excess of the linear fit, weak / plain", *whos)
    rule(2 + len(whos))
    for effect in dict.fromkeys(one["effect"] for one in cases):
        some = [one for one in cases if one["effect"] == effect]
        excess = (middle(one["excess"] for one in some if one["strength"] == at) for at in (0, 1))
        row(effect, " / ".join(f"{value:.0f}" for value in excess), *right(some))
    for title, some in parts(cases):
        row(f"**{title}**", "", *right(some))


def gap_table(cases):
    """Median ratios, and how often a correction does harm or is the best one."""
    print()
    row("held-out gap at 2 m, after / before, median", *METHODS)
    rule(1 + len(METHODS))
    for title, some in parts(cases):
        for key, what in (("clean", "to the noise-free wave"), ("measured", "to the measured mean, its error taken out")):
            row(f"{title}, {what}", *(f"{middle(one[key][name] for one in some):.2f}" for name in METHODS))
    row(f"made worse, of {len(cases)}", *(sum(one["clean"][name] > 1 for one in cases) for name in METHODS))
    best = [min(one["clean"], key=one["clean"].get) for one in cases]
    row(f"least of the three, of {len(cases)}", *(best.count(name) for name in METHODS))
    lost = sum(np.isnan(one["measured"]["flexframe"]) for one in cases)
    print(f"\nSets whose measured gap before is lost in the mean's error, left out of the measured medians: {lost}")
    print(f"Reported by flexframe itself (measured), median: {middle(one['reported'] for one in cases):.2f}")
    seconds = (f"{name} {middle(one['seconds'][name] for one in cases):.2f}" for name in cases[0]["seconds"])
    print("Processor seconds a set, median:", ", ".join(seconds))


def parts(cases):
    weak, plain = ([one for one in cases if one["strength"] == at] for at in (0, 1))
    return [(title, some) for title, some in (("all", cases), ("weak", weak), ("plain", plain)) if some]


def time_table(rows):
    """Milliseconds and ratios."""
    print()
    waves = ("difference of waves, g", "SciPy, ms a wave: RK45 (LSODA)", "over flexframe's published time")
    row("model", *waves, "SciPy, ms a refit", "flexframe, ms a refit", "ratio")
    rule(7)
    for one in rows:
        over = f"{one.rk45_s / TOOL_WAVE_S:.0f} ({one.lsoda_s / TOOL_WAVE_S:.0f})" if one.id == "linear" else "-"
        refit = f"{one.refit_s * 1e3:.0f}, {one.residuals:.1f} residuals"
        waves = f"{one.rk45_s * 1e3:.1f} ({one.lsoda_s * 1e3:.1f})"
        row(one.id, f"{one.apart_g:.4f}", waves, over, refit, f"{one.tool_s * 1e3:.2f}", f"{one.refit_s / one.tool_s:.0f}")
