# SPDX-License-Identifier: BSD-2-Clause
"""What each pixel says: error, variance, bias and inverse efficiency, and the pixels that are worst."""
from dataclasses import dataclass

import numpy as np

from .metrics import Reference
from .slices import Slice

MOST_WORST = 10


@dataclass(frozen=True)
class Maps:
    """One value a pixel, means over the channels."""
    error: np.ndarray         # root of the mean squared error of a budget's image, a mean over repeats
    variance: np.ndarray      # of a budget's image
    bias: np.ndarray          # mean of all images - reference
    bias_z: np.ndarray        # the same in standard errors
    work: np.ndarray          # variance x seconds: inverse efficiency; all pixels count the same time
    flip: np.ndarray          # LDR-FLIP of the first repeat


@dataclass(frozen=True)
class WorstPixel:
    """A pixel where the slices are farthest from the reference, and the slice that is farthest there."""
    x: int
    y: int
    share: float              # of all squared error of the slices
    value: tuple[float, ...]  # of that slice
    reference: tuple[float, ...]
    slice: Slice


def make_maps(images: list[np.ndarray], merged: list[np.ndarray], reference: Reference, slices: int, cost: float, flip: np.ndarray) -> Maps:
    """`images`: all slices; `merged`: one image for each repeat; `slices`: how many make a budget; `cost`: seconds of a slice."""
    count = len(images)
    mean, squares = np.zeros(images[0].shape), np.zeros(images[0].shape)
    for i, image in enumerate(images, 1):  # Welford's recurrence: no difference of large sums
        step = image - mean
        mean += step / i
        squares += step * (image - mean)
    variance = squares / (count - 1)
    noise = reference.variance if reference.variance is not None else 0.0
    error = np.mean([(m - reference.image)**2 for m in merged], axis=0).mean(axis=2)
    difference = (mean - reference.image).mean(axis=2)
    # Channels of one path are correlated: their mean has at most the mean of their standard errors.
    deviation = np.sqrt(variance / count + noise).mean(axis=2)
    z = np.divide(difference, deviation, out=np.zeros_like(difference), where=deviation > 0)
    return Maps(np.sqrt(error), variance.mean(axis=2) / slices, difference, z, variance.mean(axis=2) * cost, flip)


def worst_pixels(images: list[np.ndarray], slices: list[Slice], reference: np.ndarray) -> list[WorstPixel]:
    """The pixels with the largest sums of squared errors over all slices, worst first."""
    sums, largest = np.zeros(reference.shape[:2]), np.full(reference.shape[:2], -1.0)
    where = np.zeros(reference.shape[:2], int)
    for i, image in enumerate(images):
        squared = ((image - reference)**2).sum(axis=2)
        sums += squared
        where[squared > largest] = i
        largest = np.maximum(largest, squared)
    total = sums.sum()
    found = []
    for at in np.argsort(sums, axis=None)[::-1][:MOST_WORST]:
        y, x = np.unravel_index(at, sums.shape)
        if sums[y, x] <= 0:
            break
        i = where[y, x]
        found.append(WorstPixel(int(x), int(y), float(sums[y, x] / total), tuple(map(float, images[i][y, x])),
                                tuple(map(float, reference[y, x])), slices[i]))
    return found
