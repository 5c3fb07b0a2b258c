"""The turntable's parts: room, drum, columns, beam and hoops. Each is closed but the room."""

import math

from mesh import add, add_box, add_lathe, arc, turned_about_y

SEGMENTS = 96  # of the large circles


def add_room(mesh, radius, height, cove):
    """A round wall that runs into the floor through a cove; the floor goes in to the drum."""
    wall = [(radius, height), (radius, height / 2)]
    wall += arc((radius - cove, cove), cove, 0, -90, 12)
    add_lathe(mesh, "wall", wall, SEGMENTS)
    for material, outer, inner in (("floor", radius - cove, 2.78), ("inlay", 2.78, 2.66),
                                   ("floor", 2.66, 2.0)):
        add_lathe(mesh, material, [(outer, 0.0), (inner, 0.0)], SEGMENTS)


def add_drum(mesh, radius, height, bevel):
    """The step in the middle; its side starts where the floor ends."""
    side = [(radius, 0.0), (radius, height - bevel)]
    side += arc((radius - bevel, height - bevel), bevel, 0, 90, 6)[1:] + [(0.62, height)]
    add_lathe(mesh, "drum", side, SEGMENTS)


def add_pedestal(mesh, bottom, top):
    """Stands in the drum's hole, so that nothing coincides with the drum's top."""
    foot = [(0.62, bottom)] + arc((0.56, bottom + 0.05), 0.06, -50, 90, 8)
    neck = [(0.50, bottom + 0.13), (0.44, bottom + 0.28), (0.42, (bottom + top) / 2),
            (0.45, top - 0.20), (0.58, top - 0.10)]
    plate = arc((0.70, top - 0.05), 0.05, -90, 90, 10)
    add_lathe(mesh, "pedestal", foot, SEGMENTS)
    add_lathe(mesh, "pedestal", [foot[-1]] + neck + plate[:1], SEGMENTS)
    add_lathe(mesh, "pedestal", plate, SEGMENTS)
    add_lathe(mesh, "pedestal", [plate[-1], (0.0, top)], SEGMENTS)


def column_profile(height, radius):
    """Base, tapering shaft with a slight swelling (entasis), and capital."""
    points = arc((radius + 0.01, 0.145), 0.045, -90, 90, 7)
    for i in range(8):
        t = i / 7
        swelling = 0.012 * math.sin(math.pi * min(t * 1.2, 1.0))
        points.append((radius * (1.0 - 0.16 * t) + swelling, 0.22 + (height - 0.42) * t))
    top = height - 0.14
    points += arc((radius * 0.84 + 0.01, top), 0.03, -80, 80, 5)
    return points + [(radius * 1.35, height - 0.065)]


def add_column(mesh, azimuth, distance, height, radius):
    """`azimuth` in degrees from the direction away from the camera, -z, towards +x."""
    foot = turned_about_y((0.0, 0.0, -distance), -azimuth)

    def place(p):
        return add(foot, p)

    profile = column_profile(height, radius)
    caps = [[(0.0, profile[0][1]), profile[0]], [profile[-1], (0.0, profile[-1][1])]]
    for piece in (profile, *caps):
        add_lathe(mesh, "column", piece, 28, place)
    add_box(mesh, "column", place((0, 0.052, 0)), (radius * 1.5, 0.052, radius * 1.5), -azimuth)
    # The slab reaches 1 cm into the beam and the shaft 5 mm into the slab: no faces coincide.
    add_box(mesh, "column", place((0, height - 0.03, 0)),
            (radius * 1.45, 0.04, radius * 1.45), -azimuth)


def add_beam(mesh, material, distances, heights, azimuths, pieces):
    """A beam of rectangular section along an arc; each pair runs from low to high."""
    def corner(k, far, high):
        azimuth = azimuths[0] + (azimuths[1] - azimuths[0]) * k / pieces
        return turned_about_y((0.0, heights[high], -distances[far]), -azimuth)

    section = [(0, 0), (1, 0), (1, 1), (0, 1)]  # (far, high)
    for k in range(pieces):
        for (far0, high0), (far1, high1) in zip(section, section[1:] + section[:1]):
            mesh.add_flat_face(material, [corner(k, far0, high0), corner(k + 1, far0, high0),
                                          corner(k + 1, far1, high1), corner(k, far1, high1)])
    mesh.add_flat_face(material, [corner(0, *part) for part in section])
    mesh.add_flat_face(material, [corner(pieces, *part) for part in reversed(section)])


def add_hoop(mesh, material, radius, height, half_width, half_height):
    """A ring of rectangular section about the y axis."""
    inner, outer = radius - half_width, radius + half_width
    low, high = height - half_height, height + half_height
    corners = [(inner, low), (outer, low), (outer, high), (inner, high), (inner, low)]
    for piece in zip(corners, corners[1:]):
        add_lathe(mesh, material, list(piece), SEGMENTS)


def add_lattice_hoop(mesh, radius, half_height, slats):
    """Two hoops joined by slats: the moving occluder."""
    for height in (-half_height, half_height):
        add_hoop(mesh, "brass", radius, height, 0.022, 0.022)
    for i in range(slats):
        degrees = 360.0 * i / slats
        center = turned_about_y((0.0, 0.0, -radius), degrees)
        add_box(mesh, "brass", center, (0.024, half_height, 0.008), degrees)
