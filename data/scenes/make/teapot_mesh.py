"""Tessellates bicubic Bezier patches into triangles with the surface's own normals."""

from mesh import cross, normalized, scaled, subtract, add
from teapot_patches import patches

# At a pole a whole row of control points coincides and dS/du vanishes; the normal is its limit,
# taken this far inside. Its error is below the four digits an OBJ normal is written with.
POLE_STEP = 1e-6


def _bernstein(t):
    s = 1.0 - t
    return (s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t)


def _bernstein_slope(t):
    s = 1.0 - t
    return (-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t)


def _weighted_sum(patch, row_weights, column_weights):
    total = (0.0, 0.0, 0.0)
    for row, row_weight in zip(patch, row_weights):
        for point, column_weight in zip(row, column_weights):
            total = add(total, scaled(point, row_weight * column_weight))
    return total


def _normal(patch, u, v):
    along_u = _weighted_sum(patch, _bernstein(v), _bernstein_slope(u))
    along_v = _weighted_sum(patch, _bernstein_slope(v), _bernstein(u))
    normal = cross(along_u, along_v)
    if max(abs(value) for value in normal) < 1e-9:
        return _normal(patch, u, v + POLE_STEP if v < 0.5 else v - POLE_STEP)
    return normalized(normal)


def _y_up(a):
    return (a[0], a[2], -a[1])


def add_teapot(mesh, material, pieces):
    """Each patch becomes pieces x pieces quadrangles, cut along their shorter diagonal."""
    for patch in patches():
        grid = []
        for j in range(pieces + 1):
            v = j / pieces
            grid.append([(_y_up(_weighted_sum(patch, _bernstein(v), _bernstein(i / pieces))),
                          _y_up(_normal(patch, i / pieces, v)), None) for i in range(pieces + 1)])
        for j in range(pieces):
            for i in range(pieces):
                _add_quadrangle(mesh, material, [grid[j][i], grid[j][i + 1], grid[j + 1][i + 1],
                                                 grid[j + 1][i]])


def _add_quadrangle(mesh, material, corners):
    a, b, c, d = corners
    if _squared_distance(a[0], c[0]) > _squared_distance(b[0], d[0]) * (1.0 + 1e-6):
        a, b, c, d = b, c, d, a
    mesh.add_face(material, [a, b, c])
    mesh.add_face(material, [a, c, d])


def _squared_distance(a, b):
    difference = subtract(a, b)
    return sum(value * value for value in difference)
