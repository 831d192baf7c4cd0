"""Mean waves of drops, trigger-aligned as by the tool. SI units, readings in g."""

import csv
from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from sklearn.covariance import LedoitWolf

G = 9.81
STEP_S = 1e-3
FINE_S = 5e-5
TRIGGER_G = 3.0
BEFORE = 1
SAMPLES = 31
LONGEST_ONSET_S = 5e-3
# Added to the mean before deviations are divided by it: where the wave is near zero the deviations are the sensor's.
LEAST_DEVIATION_G = 2.0


@dataclass
class Group:
    """Drops from one height: a window a row."""

    height_m: float
    windows: np.ndarray

    @property
    def mean(self):
        return self.windows.mean(axis=0)

    @property
    def error(self):
        """Standard error of the mean wave."""
        return self.windows.std(axis=0, ddof=1) / np.sqrt(len(self.windows))

    def resampled(self, rng):
        return Group(self.height_m, self.windows[rng.integers(len(self.windows), size=len(self.windows))])


def read(path):
    """Groups by rising height."""
    records = defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            records[float(row["height_m"]), row["trial"]].append(float(row["accel_g"]))
    groups = defaultdict(list)
    for (height_m, _), readings in records.items():
        readings = np.array(readings)
        trigger = np.argmax(np.abs(readings) > TRIGGER_G)
        groups[height_m].append(readings[trigger - BEFORE : trigger - BEFORE + SAMPLES])
    return [Group(height_m, np.array(windows)) for height_m, windows in sorted(groups.items())]


def crossing_s(fine):
    """When a wave given every 0.05 ms first crosses the trigger."""
    at = int(np.argmax(np.abs(fine) > TRIGGER_G))
    if at == 0:
        return 0.0
    left, right = abs(fine[at - 1]), abs(fine[at])
    return min(FINE_S * (at - 1 + (TRIGGER_G - left) / (right - left)), LONGEST_ONSET_S)


def window(fine, at_s=None):
    """The mean of records of a wave whose clocks have every phase alike: means over the steps behind the trigger.

    `fine` may have columns; then `at_s` says where the trigger is.
    """
    sums = np.zeros_like(fine)
    sums[1:] = np.cumsum(0.5 * FINE_S * (fine[1:] + fine[:-1]), axis=0)
    edges_s = (crossing_s(fine) if at_s is None else at_s) + STEP_S * (np.arange(SAMPLES + 1) - BEFORE)
    place = np.maximum(edges_s, 0.0) / FINE_S
    left = np.minimum(place.astype(int), len(fine) - 2)
    part = (place - left).reshape((-1,) + (1,) * (fine.ndim - 1))
    middle = fine[left] + 0.5 * part * (fine[left + 1] - fine[left])
    return np.diff(sums[left] + FINE_S * part * middle, axis=0) / STEP_S


def whitening(groups):
    """For each height, what turns the mean wave's error into independent unit errors.

    Deviations are divided by the wave and pooled over the heights, so that 31 x 31 numbers rest on all drops; Ledoit and
    Wolf's shrinkage keeps their covariance invertible.
    """
    scaled = np.vstack([(group.windows - group.mean) / (np.abs(group.mean) + LEAST_DEVIATION_G) for group in groups])
    covariance = LedoitWolf(assume_centered=True).fit(scaled).covariance_
    covariance *= len(scaled) / (len(scaled) - len(groups))
    whites = []
    for group in groups:
        size = np.abs(group.mean) + LEAST_DEVIATION_G
        root = np.linalg.cholesky(covariance * np.outer(size, size) / len(group.windows))
        whites.append(np.linalg.inv(root))
    return whites


def net_gap(measured, error, predicted):
    """Root of the mean square distance with the mean wave's own error taken out, g."""
    return np.sqrt(max(0.0, np.mean((measured - predicted) ** 2 - error**2)))


def distance(truth, predicted):
    """Root mean square, g."""
    return np.sqrt(np.mean((truth - predicted) ** 2))
