# SPDX-License-Identifier: BSD-2-Clause
"""Scenes that several renderers can render, each in the words of PBRT-v3 and of pbrt-v4: smoke, cloud, fog and colours. All are of our own making."""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Field = np.ndarray  # of indices z, y, x


@dataclass(frozen=True)
class Words:
    """What the two languages call the same."""
    film: str
    point: str
    filter_widths: tuple[str, str]
    no_material: str
    matte: str  # and its colour
    grid: str
    sampler: str
    end: str


V3 = Words("image", "point", ("xwidth", "ywidth"), "", 'matte" "rgb Kd', "heterogeneous", "02sequence", "WorldEnd\n")
V4 = Words("rgb", "point3", ("xradius", "yradius"), "interface", 'diffuse" "rgb reflectance', "uniformgrid", "zsobol", "")
LANGUAGES = {"v3": V3, "v4": V4}


def value_noise(edge: int, octaves: int, base: int, seed: int) -> Field:
    """Random lattices of base, 2 base, ... cells an edge, smoothly interpolated and added up, each half as strong as the one before; in about [-1, 1]."""
    chance = np.random.default_rng(seed)
    total = np.zeros((edge,) * 3)
    for octave in range(octaves):
        cells = base << octave
        lattice = chance.uniform(-1, 1, (cells + 1,) * 3)
        x = (np.arange(edge) + 0.5) / edge * cells
        low = x.astype(int)
        share = x - low
        share = share * share * (3 - 2 * share)
        for axis in range(3):
            weight = share.reshape([edge if a == axis else 1 for a in range(3)])
            lattice = np.take(lattice, low, axis) * (1 - weight) + np.take(lattice, low + 1, axis) * weight
        total += lattice / 2 ** octave
    return total / 2


def puff(edge: int, octaves: int, empty: float, seed: int) -> Field:
    """A ball with an eroded border, of which the share `empty` (more than .6) of the box is 0; values in [0, 1], of two decimals."""
    c = (np.arange(edge) + 0.5) / edge * 2 - 1
    distance = np.sqrt(c[:, None, None] ** 2 + c[None, :, None] ** 2 + c[None, None, :] ** 2)
    body = 1.2 * value_noise(edge, octaves, 4, seed) - 1.5 * distance
    body[distance > 0.95] = -np.inf
    floor = np.quantile(body, empty)
    return np.round(np.clip((body - floor) / (body.max() - floor) * 2, 0, 1), 2)


def numbers(field: Field) -> str:
    return "\n".join(" ".join(f"{v:g}" for v in row) for row in field.reshape(field.shape[0], -1).tolist())


def rgb(values: tuple[float, float, float]) -> str:
    return "[ " + " ".join(f"{v:g}" for v in values) + " ]"


def frame(words: Words, edge: int, depth: int, view: str, fov: float, world: str, around: str = "") -> str:
    """A square picture of `edge` pixels, box filter, one sample a pixel unless the command line says other; `around` is what the camera is in."""
    x, y = words.filter_widths
    return (f'Film "{words.film}" "string filename" "image.pfm" "integer xresolution" {edge} "integer yresolution" {edge}\n'
            f'PixelFilter "box" "float {x}" .5 "float {y}" .5\n'
            f'Sampler "{words.sampler}" "integer pixelsamples" 1\n'
            f'Integrator "volpath" "integer maxdepth" {depth}\n'
            f'{view}\n{around}Camera "perspective" "float fov" {fov:g}\nWorldBegin\n{world}{words.end}')


def box(words: Words) -> str:
    """From -1 to 1, the boundary of the medium "m"."""
    return (f'AttributeBegin\nMaterial "{words.no_material}"\nMediumInterface "m" ""\n'
            'Shape "trianglemesh" "integer indices" [ 0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7 ]\n'
            f'  "{words.point} P" [ -1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1 ]\nAttributeEnd\n')


def grid(words: Words, field: Field, sigma_a: tuple, sigma_s: tuple, g: float) -> str:
    z, y, x = field.shape
    return (f'MakeNamedMedium "m" "string type" "{words.grid}" "integer nx" {x} "integer ny" {y} "integer nz" {z}\n'
            f'  "{words.point} p0" [ -1 -1 -1 ] "{words.point} p1" [ 1 1 1 ] "rgb sigma_a" {rgb(sigma_a)} "rgb sigma_s" {rgb(sigma_s)} "float g" {g:g}\n'
            f'  "float density" [\n{numbers(field)}\n]\n')


def floor(words: Words, z: float) -> str:
    return (f'Material "{words.matte}" [ .5 .5 .5 ]\nShape "trianglemesh" "integer indices" [ 0 1 2 2 3 0 ] '
            f'"{words.point} P" [ -9 -9 {z:g}  9 -9 {z:g}  9 9 {z:g}  -9 9 {z:g} ]\n')


def sun_and_sky(words: Words, sky: float, sun: float) -> str:
    return (f'LightSource "infinite" "rgb L" {rgb((sky,) * 3)}\n'
            f'LightSource "distant" "{words.point} from" [ -3 -1 3 ] "{words.point} to" [ 0 0 0 ] "rgb L" {rgb((sun,) * 3)}\n')


VIEW = "LookAt 0 -5 1  0 0 0  0 0 1"


def depth_across(field: Field) -> float:
    """Of the deepest line of voxels along y through the box of two units, for a coefficient of 1."""
    return float(field.sum(axis=1).max()) * 2 / field.shape[1]


def cloud(words: Words, picture: int, volume: int) -> str:
    """A cloud of optical depth 50, 92 % of its box empty, albedo .99, g .8, under sun and sky."""
    field = puff(volume, 5, 0.92, 7)
    sigma = 50 / depth_across(field)
    return frame(words, picture, 200, VIEW, 15, sun_and_sky(words, 0.5, 3) + grid(words, field, (0.01 * sigma,) * 3, (0.99 * sigma,) * 3, 0.8) + box(words))


def smoke(words: Words, picture: int, volume: int) -> str:
    """A third as large a volume, of optical depth 8, 70 % of its box empty, albedo .8, scattering evenly, over a floor."""
    field = puff(max(8, volume // 3), 4, 0.7, 3)
    sigma = 8 / depth_across(field)
    return frame(words, picture, 100, VIEW, 30, sun_and_sky(words, 0.3, 2) + floor(words, -1.1) + grid(words, field, (0.2 * sigma,) * 3, (0.8 * sigma,) * 3, 0) + box(words))


def fog(words: Words, picture: int, _: int) -> str:
    """A spot light with a soft edge through thin fog, and the shadow of a ball in it."""
    around = ('MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_a" [ .02 .02 .02 ] "rgb sigma_s" [ .1 .1 .1 ] "float g" 0\n'
              'MediumInterface "" "m"\n')
    world = ('MediumInterface "m" "m"\n'
             f'LightSource "spot" "{words.point} from" [ -3 0 3 ] "{words.point} to" [ 0 0 0 ] "rgb I" [ 60 60 60 ] "float coneangle" 20 "float conedeltaangle" 3\n'
             f'{floor(words, -1)}Shape "sphere" "float radius" .5\n'
             f'AttributeBegin\nMaterial "{words.no_material}"\nMediumInterface "m" ""\nShape "sphere" "float radius" 30\nAttributeEnd\n')
    return frame(words, picture, 5, "LookAt 0 -6 1.5  0 0 .5  0 0 1", 40, world, around)


def colours(words: Words, picture: int, volume: int) -> str:
    """A third as large a volume, whose extinctions are as .5 to 1 to 4."""
    field = puff(max(8, volume // 3), 4, 0.7, 5)
    sigma = 5 / depth_across(field)
    scattering = tuple(sigma * c * a for c, a in ((0.5, 0.9), (1, 0.95), (4, 0.99)))
    absorption = tuple(sigma * c * (1 - a) for c, a in ((0.5, 0.9), (1, 0.95), (4, 0.99)))
    return frame(words, picture, 100, VIEW, 25, sun_and_sky(words, 0.5, 2) + grid(words, field, absorption, scattering, 0.3) + box(words))


SCENES: dict[str, Callable[[Words, int, int], str]] = {"smoke": smoke, "cloud": cloud, "fog": fog, "colours": colours}
