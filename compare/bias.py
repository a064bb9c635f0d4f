# SPDX-License-Identifier: BSD-2-Clause
"""Whether the mean of many images is the reference: bias apart from noise."""
import math

import numpy as np

from .intervals import Estimate, mean_estimate, welch

BLOCK = 1 << 16


def gram(images: list[np.ndarray], base: np.ndarray) -> np.ndarray:
    """Mean products of all pairs of images less `base`: all that follows needs no more of the images."""
    out = np.zeros((len(images), len(images)))
    flat = [image.reshape(-1) for image in images]
    zero = base.reshape(-1)
    for begin in range(0, zero.size, BLOCK):
        block = np.array([image[begin:begin + BLOCK] for image in flat], np.float64) - zero[begin:begin + BLOCK]
        out += block @ block.T
    return out / zero.size


def pair_mean(products: np.ndarray) -> float:
    """Mean of the products of different images: the mean square of their common part, without their noise."""
    count = len(products)
    return float((products.sum() - np.trace(products)) / (count * (count - 1)))


def squared_distance(products: np.ndarray, count: int) -> float:
    """Mean squared difference of the expectations of two groups of images, the first `count` ones and the others; without bias.
    A group of one image (a reference with unknown noise) counts with its noise."""
    first, second, across = products[:count, :count], products[count:, count:], products[:count, count:]
    own = [pair_mean(p) if len(p) > 1 else float(p[0, 0]) for p in (first, second)]
    return own[0] + own[1] - 2 * float(across.mean())


def jackknife_variance(products: np.ndarray, count: int, indices: range) -> float:
    """Variance of squared_distance by leaving out each image of `indices` in turn."""
    values = []
    for i in indices:
        rest = np.delete(np.delete(products, i, 0), i, 1)
        values.append(squared_distance(rest, count - (i < count)))
    return float((len(values) - 1) * np.var(values))


def squared_bias(images: list[np.ndarray], references: list[np.ndarray]) -> Estimate:
    """Mean over the image of the squared bias, with the noise of both groups taken out; negative values are chance. Its error
    is a jackknife over the images of both groups. At least three images and one reference, all of one size."""
    everything = [*images, *references]
    products = gram(everything, np.mean([r.astype(np.float64) for r in references], axis=0))
    count = len(images)
    variance = jackknife_variance(products, count, range(count))
    if len(references) > 2:
        variance += jackknife_variance(products, count, range(count, len(everything)))
    return Estimate(squared_distance(products, count), math.sqrt(variance), count - 1)


def mean_signed(images: list[np.ndarray], references: list[np.ndarray]) -> Estimate:
    """Mean over the image of (mean image - reference), with the standard error of both."""
    first = mean_estimate([float(image.mean(dtype=np.float64)) for image in images])
    second = mean_estimate([float(image.mean(dtype=np.float64)) for image in references])
    if len(references) == 1:  # a given reference: its noise is not known
        second = Estimate(second.value, 0, 1)
    return welch(first, second)
