# SPDX-License-Identifier: BSD-2-Clause
"""A game of chess near its end on a board of 5 x 5 fields, as PBRT input: figure 1 of Georgiev et al. 2019."""
import math

Profile = list[tuple[float, float]]

PIECES: dict[str, Profile] = {
    "pawn": [(.27, 0), (.27, .08), (.15, .2), (.09, .46), (.17, .5), (.09, .54), (.16, .62), (.18, .71), (.13, .82), (0, .87)],
    "rook": [(.32, 0), (.32, .1), (.2, .22), (.16, .62), (.26, .68), (.26, .88), (.17, .88), (.17, .8), (0, .8)],
    "bishop": [(.32, 0), (.32, .1), (.17, .25), (.11, .66), (.21, .71), (.12, .75), (.19, .9), (.15, 1.03), (.05, 1.14), (.07, 1.19), (0, 1.25)],
    "king": [(.36, 0), (.36, .1), (.2, .28), (.14, .84), (.26, .9), (.15, .94), (.25, 1.3), (.12, 1.35), (.05, 1.38), (.1, 1.45), (.05, 1.52), (0, 1.54)],
}
"""Radius and height along the outline of each, from the rim of its foot to the axis."""

GAME = {(0, 3): "rook", (3, 4): "king", (1, 2): "pawn", (2, 3): "pawn", (4, 3): "bishop", (3, 1): "king", (1, 0): "bishop", (4, 1): "pawn", (2, 0): "pawn", (0, 1): "rook"}
FIELDS = 5
GAP = 0.01
"""Between fields, and below pieces: no two boundaries touch."""


def lathe(profile: Profile, x: float, y: float, segments: int = 24) -> str:
    """A closed surface of revolution, its normals outward."""
    rings = [(r, z) for r, z in profile if r > 0]
    points = [(x + r * math.cos(a), y + r * math.sin(a), z + GAP) for r, z in rings for a in (2 * math.pi * i / segments for i in range(segments))]
    foot, top = len(points), len(points) + 1
    points += [(x, y, rings[0][1] + GAP), (x, y, profile[-1][1] + GAP)]
    faces = []
    last = (len(rings) - 1) * segments
    for i in range(segments):
        j = (i + 1) % segments
        faces += [(foot, j, i), (top, last + i, last + j)]
        for low in range(0, last, segments):
            high = low + segments
            faces += [(low + i, low + j, high + j), (low + i, high + j, high + i)]
    return mesh(points, faces)


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> str:
    points = [(x, y, z) for z in (low[2], high[2]) for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
    return mesh(points, [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)])


def mesh(points: list[tuple[float, float, float]], faces: list[tuple[int, int, int]]) -> str:
    return ('Shape "trianglemesh" "integer indices" [ ' + " ".join(f"{a} {b} {c}" for a, b, c in faces) + ' ]\n  "point P" [ ' +
            " ".join(f"{a:.5g} {b:.5g} {c:.5g}" for a, b, c in points) + " ]\n")


def game() -> str:
    """Fields of the media `light` and `dark`, pieces of `piece`; the board is centred at the origin, its top at 0."""
    parts = []
    for column in range(FIELDS):
        for row in range(FIELDS):
            x, y = column - FIELDS / 2, row - FIELDS / 2
            parts.append(f'MediumInterface "{"dark" if (column + row) % 2 == 0 else "light"}" ""\n' + box((x + GAP, y + GAP, -0.3), (x + 1 - GAP, y + 1 - GAP, 0)))
    parts.append('MediumInterface "piece" ""\n')
    parts += [lathe(PIECES[name], column + 0.5 - FIELDS / 2, row + 0.5 - FIELDS / 2) for (column, row), name in GAME.items()]
    return "".join(parts)
