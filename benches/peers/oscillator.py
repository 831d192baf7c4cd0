"""Spring, damper and one more effect behind the sensor's first-order filter, by SciPy's solve_ivp and least_squares."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

from waves import FINE_S, G, LONGEST_ONSET_S, SAMPLES, STEP_S, window

MASS_KG = 0.241
CUTOFF_1_S = 500.0
LIMIT_G = 230.0
WINDOW_S = LONGEST_ONSET_S + STEP_S * (SAMPLES + 1)
ERROR = [1e-8, 1e-6, 1e-4, 1e-4]  # absolute: m, m/s, g, N
# A step that lowers the sum of squares by less is the last one; the tool's own limit.
ENOUGH = 1e-3


@dataclass(frozen=True)
class Effect:
    """What comes on top of k and c: names, where a fit begins, bounds, scales."""

    id: str
    keys: tuple = ()
    start: tuple = ()
    low: tuple = ()
    high: tuple = ()


EFFECTS = [
    Effect("linear"),
    Effect("cubic_stiffness", ("k3",), (1e6,), (-2e7,), (2e8,)),
    Effect("coulomb_friction", ("f_c_n",), (2.0,), (0.0,), (80.0,)),
    Effect("maxwell_branch", ("k_m", "tau_ms"), (2e3, 3.0), (0.0, 0.2), (4e4, 20.0)),
]


def rates(effect, values):
    """Right-hand side for the states x, v, reading (g), Maxwell's force."""
    k, c, *own = (float(value) for value in values)
    id = effect.id

    def right(_, state):
        x, v, reading, branch = state.tolist()  # plain floats are twice as fast as NumPy's
        force, change = k * x + c * v, 0.0
        if id == "cubic_stiffness":
            force += own[0] * x * x * x
        elif id == "coulomb_friction":
            force += own[0] * math.tanh(v / 0.05)
        elif id == "maxwell_branch":
            force += branch
            change = own[0] * v - branch / (own[1] * 1e-3)
        return v, G - force / MASS_KG, CUTOFF_1_S * (force / MASS_KG / G - reading), change

    return right


def states(effect, values, height_m, until_s=WINDOW_S, method="RK45"):
    """States every 0.05 ms from first touch on."""
    times_s = np.arange(int(until_s / FINE_S) + 1) * FINE_S
    begin = [0.0, np.sqrt(2 * G * height_m), 0.0, 0.0]
    solved = solve_ivp(rates(effect, values), (0.0, times_s[-1]), begin, method, times_s, rtol=1e-6, atol=ERROR)
    return solved.y


def wave(effect, values, height_m, until_s=WINDOW_S, method="RK45"):
    """The sensor's reading every 0.05 ms from first touch on, g."""
    return np.clip(states(effect, values, height_m, until_s, method)[2], -LIMIT_G, LIMIT_G)


def fit(effect, groups, whites, start=None):
    """Values with the least whitened distance of the mean waves."""
    means = [group.mean for group in groups]
    evaluations = 0

    def residual(values):
        nonlocal evaluations
        evaluations += 1
        pairs = zip(groups, means, whites)
        return np.concatenate([white @ (mean - window(wave(effect, values, group.height_m))) for group, mean, white in pairs])

    start = np.array(start if start is not None else (7040.0, 46.0) + effect.start)
    low, high = np.array((10.0, 0.0) + effect.low), np.array((1e6, 2000.0) + effect.high)
    widths = (max(abs(value), 1e-3 * (b - a)) for value, a, b in zip(effect.start, effect.low, effect.high))
    scale = np.array((1e3, 10.0, *widths))
    # A relative limit is what least_squares has; the sum at the end is about the number of samples.
    limits = {"ftol": ENOUGH / (SAMPLES * len(groups)), "xtol": 1e-10, "gtol": 1e-10}
    done = least_squares(residual, start, bounds=(low, high), x_scale=scale, diff_step=1e-4, **limits)
    done.evaluations = evaluations
    return done
