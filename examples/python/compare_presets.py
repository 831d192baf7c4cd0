"""Compares the presets: what they weigh and on what, how far they are from their limits, and the peak of a drop from 1 m.

    pip install pandas matplotlib
    python compare_presets.py presets.png

The program is asked through `flexframe --json`; FLEXFRAME names it, default "flexframe". The lines `# %%` begin cells: VS Code,
Spyder and Jupyter (with jupytext) open this file as a notebook.
"""
# %%
import json
import os
import subprocess
import sys

import matplotlib
import pandas as pd

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PRESETS = ["cognifly", "cognifly-v8", "cognifly-1106", "cognifly-2s2000", "cognifly-bamboo", "cognifly-mini"]
BUDGET_RULES = {"mass_budget": "mass", "envelope": "envelope", "propeller_clearance": "propeller\nclearance", "ground_clearance": "ground\nclearance"}


def flexframe(*arguments):
    """The answer of a command. Exit code 1 says that a limit is violated, which the answer says, too."""
    done = subprocess.run([os.environ.get("FLEXFRAME", "flexframe"), *arguments, "--json"], capture_output=True, text=True)
    if done.returncode > 1:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


# %% One call checks all frames. One row a line of the mass table, one row a finding.
frames = flexframe("check", *PRESETS)["frames"]
masses = pd.DataFrame([{"frame": frame["frame"], **line} for frame in frames for line in frame["masses"]["lines"]])
findings = pd.DataFrame([{"frame": frame["frame"], **finding} for frame in frames for finding in frame["findings"]])

# Grams by frame and group, in the order of PRESETS.
by_group = masses.pivot_table(index="frame", columns="kind", values="total_g", aggfunc="sum").loc[PRESETS].fillna(0.0)
# The smallest margin of each rule as a share of its limit. Notes have no limit to keep.
limited = findings[(findings["verdict"] != "note") & findings["rule"].isin(BUDGET_RULES)].copy()
limited["share"] = limited["margin"] / limited["limit"]
margins = limited.pivot_table(index="frame", columns="rule", values="share", aggfunc="min").loc[PRESETS, list(BUDGET_RULES)]

budgets = findings[findings["rule"] == "mass_budget"].set_index("frame")["limit"]

# %% The peak of a drop from 1 m as the sensor sees it. The stiffness of this model does not follow from the geometry: the frame gives mass and gap.
drops = [flexframe("drop", name, "--model", "paper-corrected", "--height", "1") for name in PRESETS]
peaks = pd.Series({name: drop["heights"][0]["peak_sensor_g"] for name, drop in zip(PRESETS, drops)})

table = by_group.assign(total=by_group.sum(axis=1), peak_g=peaks)
print(table.round(1).to_string())


# %% Three panels: masses by group, margins, peaks.
def draw(path):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(14, 4.6), width_ratios=[5, 4, 2.2], layout="constrained", sharey=True)
    by_group.plot.barh(stacked=True, ax=left, width=0.7, color=["#4477aa", "#bbbbbb", "#ee6677", "#228833"])
    for row, total in enumerate(by_group.sum(axis=1)):
        left.text(total - 2, row, f"{total:.0f}", va="center", ha="right", fontsize=8, color="white")
    # Each frame states its own budget.
    left.plot(budgets[PRESETS], range(len(PRESETS)), "k|", markersize=28, label="budget")
    left.set(xlabel="take-off mass, g", ylabel="", xlim=(0, 1.05 * budgets.max()))
    left.legend(fontsize=8, ncols=5, markerscale=0.35, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    left.invert_yaxis()

    shown = margins.rename(columns=BUDGET_RULES) * 100
    middle.imshow(shown.clip(-20, 20), cmap="RdYlGn", vmin=-20, vmax=20, aspect="auto")
    for row, values in enumerate(shown.to_numpy()):
        for column, value in enumerate(values):
            colour = "white" if abs(value) > 15 else "black"
            middle.text(column, row, f"{value:+.1f} %", ha="center", va="center", fontsize=8, color=colour)
    middle.set_xticks(range(shown.shape[1]), shown.columns, fontsize=8)
    middle.set_title("smallest margin, share of the limit", fontsize=9)

    right.barh(range(len(PRESETS)), peaks[PRESETS], height=0.7, color="tab:blue")
    for row, peak in enumerate(peaks[PRESETS]):
        right.text(peak - 2, row, f"{peak:.0f}", va="center", ha="right", fontsize=8, color="white")
    right.set(xlabel="peak of a drop from 1 m, g")
    figure.savefig(path, dpi=110)


draw(sys.argv[1] if len(sys.argv) > 1 else "presets.png")
