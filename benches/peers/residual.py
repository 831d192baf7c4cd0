"""What is left of the linear model, learnt without a name: a Gaussian process and a polynomial."""

import itertools
import warnings

import numpy as np
from scipy.signal import lfilter
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel

from oscillator import CUTOFF_1_S, EFFECTS, LIMIT_G, states
from waves import BEFORE, FINE_S, G, SAMPLES, crossing_s, window

LINEAR = EFFECTS[0]
DEGREE = 3
RIDGES = [1e-6, 1e-4, 1e-2, 1.0, 100.0]  # the last one leaves the linear model as it is
SPEED_M_S, DEPTH_M = 5.0, 0.015  # sizes of v and x, so that a ridge means the same for every power


def speed_m_s(height_m):
    return np.sqrt(2 * G * height_m)


class Base:
    """The fitted linear model: its window at a height and the way there."""

    def __init__(self, values):
        self.values = values

    def fine(self, height_m):
        return states(LINEAR, self.values, height_m)

    def window(self, height_m):
        return window(np.clip(self.fine(height_m)[2], -LIMIT_G, LIMIT_G))


def gaussian_process(groups, base, height_m):
    """Window at `height_m`: linear model plus a process over time and impact speed, with the mean waves' own errors.

    What is left is divided by the impact speed first: to most effects it is nearly proportional.
    """

    def places(height_m):
        return np.column_stack([np.arange(SAMPLES) - BEFORE, np.full(SAMPLES, speed_m_s(height_m))])

    left = np.concatenate([(group.mean - base.window(group.height_m)) / speed_m_s(group.height_m) for group in groups])
    error = np.concatenate([group.error / speed_m_s(group.height_m) for group in groups])
    size = left.std()
    kernel = ConstantKernel(1.0, (1e-2, 1e3)) * RBF([3.0, 3.0], [(0.3, 100.0), (0.3, 100.0)])
    process = GaussianProcessRegressor(kernel, alpha=(error / size) ** 2 + 1e-8, n_restarts_optimizer=2, random_state=0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a length scale at its bound is an answer here
        process.fit(np.vstack([places(group.height_m) for group in groups]), left / size)
    return base.window(height_m) + speed_m_s(height_m) * size * process.predict(places(height_m))


def features(base, height_m):
    """Windows of the powers of x and v along the linear model's way, each through the sensor's filter."""
    x, v, reading, _ = base.fine(height_m)
    x, v = x / DEPTH_M, v / SPEED_M_S
    powers = [(i, j) for i, j in itertools.product(range(DEGREE + 1), repeat=2) if i + j <= DEGREE]
    columns = np.column_stack([x**i * v**j for i, j in powers])
    kept = np.exp(-CUTOFF_1_S * FINE_S)
    return window(lfilter([1 - kept], [1, -kept], columns, axis=0), crossing_s(reading))


def ridge(columns, target, weight, amount):
    a, b = columns * weight[:, None], target * weight
    return np.linalg.solve(a.T @ a + amount * np.trace(a.T @ a) / a.shape[1] * np.eye(a.shape[1]), a.T @ b)


def polynomial(groups, base, height_m):
    """Window at `height_m`: linear model plus a polynomial in x and v.

    The ridge is the one that predicts a left-out height best; samples weigh by their standard error.
    """
    lefts = [group.mean - base.window(group.height_m) for group in groups]
    weights = [1 / (group.error + 0.05) for group in groups]
    columns = [features(base, group.height_m) for group in groups]

    def law(of, amount):
        return ridge(*(np.concatenate([parts[i] for i in of]) for parts in (columns, lefts, weights)), amount)

    def missed(amount):
        score = 0.0
        for out in range(len(groups)):
            rest = [i for i in range(len(groups)) if i != out]
            score += np.sum((weights[out] * (lefts[out] - columns[out] @ law(rest, amount))) ** 2)
        return score

    best = min(RIDGES, key=missed)
    return base.window(height_m) + features(base, height_m) @ law(range(len(groups)), best)
