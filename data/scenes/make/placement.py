"""Placing lights: axes and polygons that face a point."""

import math

from mesh import add, cross, normalized, scaled, subtract


def axes_facing(position, target, half_width, half_height):
    """Half-axes u (level) and v of a rect at `position` that emits towards `target`."""
    forward = normalized(subtract(target, position))
    u = normalized(cross((0.0, 1.0, 0.0), forward))
    v = cross(forward, u)
    return scaled(u, half_width), scaled(v, half_height)


def polygon_facing(position, target, radius, corners):
    """A regular polygon at `position` that emits towards `target`."""
    u, v = axes_facing(position, target, radius, radius)
    result = []
    for i in range(corners):
        angle = 2.0 * math.pi * i / corners
        result.append(add(position, add(scaled(u, math.cos(angle)), scaled(v, math.sin(angle)))))
    return result

