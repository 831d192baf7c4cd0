"""The force law by sparse regression: PySINDy's STLSQ on x, v and force that are read back from the mean waves."""

import warnings

import numpy as np
from pysindy import STLSQ
from scipy.interpolate import CubicSpline

from oscillator import CUTOFF_1_S, MASS_KG
from residual import speed_m_s
from waves import BEFORE, G, SAMPLES, STEP_S, TRIGGER_G

KINKS_MM = [4.0, 7.0, 10.0, 13.0]
THRESHOLDS = np.geomspace(1.0, 1e-3, 25)  # of the whole force's norm
RIDGE = 1e-2
POINTS = 2  # a sample: its middle and its end


def library(x, v):
    """Column and the effect it stands for; None for the base's."""
    columns = [
        (None, x),
        (None, v),
        ("cubic_stiffness", x**3),
        ("hunt_crossley_damping", x * v),
        ("quadratic_damping", v * np.abs(v)),
        ("coulomb_friction", np.tanh(v / 0.05)),
        ("preload", np.tanh(x / 2e-4)),
    ]
    for kink_mm in KINKS_MM:
        deep = np.maximum(x - kink_mm * 1e-3, 0.0)
        columns.append(("bilinear_stiffness", deep))
        columns.append(("bottoming", deep**1.5 * np.maximum(1 + 0.45 * v, 0.0)))
    return [name for name, _ in columns], np.column_stack([column for _, column in columns])


def motion(group, undo_filter):
    """x, v, force (N) and its standard error, at the middles and ends of the samples.

    A mean sample is the wave's mean over a step behind the trigger, so the running sum is the wave's integral without error;
    a spline through it gives the wave and its slope. With y' = w (F/m - y) the integral of F/m is that of y plus y / w.
    """
    readings, error = group.mean[BEFORE:] * G, group.error[BEFORE:] * G
    slope = max((readings[1] - readings[0]) / STEP_S, readings[0] / STEP_S)
    touch_s = TRIGGER_G * G / slope  # from first touch to the trigger
    edges_s = touch_s + np.arange(len(readings) + 1) * STEP_S
    first = 0.5 * TRIGGER_G * G * touch_s
    sums = CubicSpline(np.append(0.0, edges_s), np.append(0.0, first + np.append(0.0, np.cumsum(readings) * STEP_S)))
    fine_s = np.linspace(0.0, edges_s[-1], 2000)
    lag = 1 / CUTOFF_1_S if undo_filter else 0.0
    v = speed_m_s(group.height_m) + G * fine_s - sums(fine_s) - lag * sums(fine_s, 1)
    x = np.append(0.0, np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(fine_s)))
    at_s = touch_s + STEP_S / POINTS * np.arange(1, POINTS * (SAMPLES - BEFORE) - 1)
    force = MASS_KG * (sums(at_s, 1) + lag * sums(at_s, 2))
    spread = MASS_KG * np.interp(at_s, edges_s[:-1] + 0.5 * STEP_S, error) * (1 + lag / STEP_S)
    return np.interp(at_s, fine_s, x), np.interp(at_s, fine_s, v), force, spread + 0.05


def sparse(columns, force, weight, threshold):
    """STLSQ on columns of unit norm, the force's norm being one: a threshold is a share of the force."""
    a, b = columns * weight[:, None], force * weight
    norms = np.maximum(np.linalg.norm(a, axis=0), 1e-12)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # everything below the threshold is an answer
        return STLSQ(threshold=threshold, alpha=RIDGE, max_iter=50).fit(a / norms, (b / np.linalg.norm(b))[:, None]).coef_[0]


def named(groups, undo_filter=True):
    """The effect whose term carries most of the force in the sparsest law that has more than x and v."""
    parts = [motion(group, undo_filter) for group in groups]
    tables = [library(x, v) for x, v, _, _ in parts]
    names = tables[0][0]
    columns = np.concatenate([columns for _, columns in tables])
    force, spread = (np.concatenate([part[at] for part in parts]) for at in (2, 3))
    for threshold in THRESHOLDS:
        shares = sparse(columns, force, 1 / spread, threshold)
        extra = {i: abs(share) for i, share in enumerate(shares) if names[i] is not None and share != 0}
        if extra:
            return names[max(extra, key=extra.get)]
    return None
