"""Newell's teapot: 32 bicubic Bezier patches over 306 control points, and its tessellation.

Martin Newell, "The utilization of procedure models in digital image synthesis" (1975); the numbers
are those of the data set that has circulated ever since (z up, the spout along +x). Six bands turn
about the z axis: a band is the four rows (radius, height) of a quarter, whose control points are
(r, 0), (r, -k r), (k r, -r), (0, -r) with k = 0.56, and its three rotations. The knob's second row
alone has k = 0.5625. Handle and spout are given for y <= 0 and mirrored.
"""

QUARTER = 0.56
KNOB_QUARTER = 0.5625

BANDS = [  # rows (radius, height); walking along them, the outside lies to the left
    [(1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)],  # rim
    [(1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)],            # upper body
    [(2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)],            # lower body
    [(0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)],             # knob
    [(0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)],              # lid
    [(1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)],           # bottom
]

# Rows (x0, z0, x1, z1, width) with the control points (x0, 0, z0), (x0, -width, z0),
# (x1, -width, z1), (x1, 0, z1).
HANDLE = [
    [(-1.6, 2.025, -1.5, 2.25, 0.3), (-2.3, 2.025, -2.5, 2.25, 0.3),
     (-2.7, 2.025, -3.0, 2.25, 0.3), (-2.7, 1.8, -3.0, 1.8, 0.3)],
    [(-2.7, 1.8, -3.0, 1.8, 0.3), (-2.7, 1.575, -3.0, 1.35, 0.3),
     (-2.5, 1.125, -2.65, 0.9375, 0.3), (-2.0, 0.9, -1.9, 0.6, 0.3)],
]
SPOUT = [
    [(1.7, 1.425, 1.7, 0.6, 0.66), (2.6, 1.425, 3.1, 0.825, 0.66),
     (2.3, 2.1, 2.4, 2.025, 0.25), (2.7, 2.4, 3.3, 2.4, 0.25)],
    [(2.7, 2.4, 3.3, 2.4, 0.25), (2.8, 2.475, 3.525, 2.49375, 0.25),
     (2.9, 2.475, 3.45, 2.5125, 0.15), (2.8, 2.4, 3.2, 2.4, 0.15)],
]


def _band_row(radius, height, quarter_turns):
    k = KNOB_QUARTER if radius == 0.8 else QUARTER
    row = [(radius, 0.0), (radius, -k * radius), (k * radius, -radius), (0.0, -radius)]
    for _ in range(quarter_turns):
        row = [(y, -x) for x, y in row]
    return [(x, y, height) for x, y in row]


def _tube_row(x0, z0, x1, z1, width):
    return [(x0, 0.0, z0), (x0, -width, z0), (x1, -width, z1), (x1, 0.0, z1)]


def patches():
    """All 32 as four rows of four control points (x, y, z), z up.

    With u along a row and v from row to row, dS/du x dS/dv points outwards.
    """
    result = []
    for band in BANDS:
        for quarter_turns in range(4):
            result.append([_band_row(r, z, quarter_turns) for r, z in band])
    for part in HANDLE + SPOUT:
        rows = [_tube_row(*row) for row in part]
        result.append(rows)
        result.append([[(x, -y, z) for x, y, z in reversed(row)] for row in rows])
    return result
