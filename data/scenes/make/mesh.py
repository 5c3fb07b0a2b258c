"""Triangle meshes and the shapes the scenes are built from, written as Wavefront OBJ.

Positions that print alike are one vertex, so parts that meet share it and leave no crack. Output
depends on the calls alone: no times, no random state, no unordered containers.
"""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return scaled(a, 1.0 / length)


def turned_about_y(a, degrees):
    """Counter-clockwise seen from above, as the scene file's `rotate`."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (c * a[0] + s * a[2], a[1], c * a[2] - s * a[0])


def number_text(value, digits):
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class _Pool:
    """OBJ lines of one kind (v, vn, vt), numbered from 1; equal lines are one entry."""

    def __init__(self, keyword, digits):
        self.keyword, self.digits = keyword, digits
        self.lines, self.index = [], {}

    def add(self, values):
        line = " ".join([self.keyword] + [number_text(value, self.digits) for value in values])
        if line not in self.index:
            self.lines.append(line)
            self.index[line] = len(self.lines)
        return self.index[line]


class Mesh:
    """Faces, counter-clockwise seen from the side they show, grouped by material."""

    def __init__(self, position_digits=5):
        self.positions = _Pool("v", position_digits)
        self.uvs = _Pool("vt", 5)
        self.normals = _Pool("vn", 4)
        self.faces = []  # (material, text of the corners)

    def add_face(self, material, corners):
        """`corners` are (position, normal or None, uv or None); equal corners are merged."""
        texts, seen = [], []
        for position, normal, uv in corners:
            p = self.positions.add(position)
            if p in seen:
                continue
            seen.append(p)
            t = str(self.uvs.add(uv)) if uv is not None else ""
            n = f"/{self.normals.add(normal)}" if normal is not None else ""
            texts.append(f"{p}/{t}{n}" if t or n else str(p))
        if len(texts) >= 3:
            self.faces.append((material, " ".join(texts)))

    def add_flat_face(self, material, positions, uvs=None):
        """A planar convex face with its own normal."""
        normal = normalized(cross(subtract(positions[1], positions[0]),
                                  subtract(positions[2], positions[0])))
        uvs = uvs or [None] * len(positions)
        self.add_face(material, [(p, normal, uv) for p, uv in zip(positions, uvs)])

    def write(self, path, comment, material_file):
        lines = [f"# {comment}", f"mtllib {material_file}"]
        lines += self.positions.lines + self.uvs.lines + self.normals.lines
        current = None
        for material, text in self.faces:
            if material != current:
                lines.append(f"usemtl {material}")
                current = material
            lines.append(f"f {text}")
        path.write_text("\n".join(lines) + "\n")


def add_box(mesh, material, center, half, degrees_about_y=0.0):
    """A closed box; `half` holds its half extents."""
    def corner(x, y, z):
        offset = turned_about_y((x * half[0], y * half[1], z * half[2]), degrees_about_y)
        return add(center, offset)

    sides = [((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)),
             ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1)),
             ((1, -1, 1), (1, -1, -1), (1, 1, -1), (1, 1, 1)),
             ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1)),
             ((-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1)),
             ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1))]
    for side in sides:
        mesh.add_flat_face(material, [corner(*signs) for signs in side])


def _profile_normals(points):
    """Normals to the right of the way, averaged where two pieces meet."""
    pieces = []
    for (r0, y0), (r1, y1) in zip(points, points[1:]):
        length = math.hypot(r1 - r0, y1 - y0)
        pieces.append(((y1 - y0) / length, (r0 - r1) / length))
    normals = []
    for i in range(len(points)):
        around = pieces[max(i - 1, 0):i + 1]
        r, y = sum(p[0] for p in around), sum(p[1] for p in around)
        length = math.hypot(r, y)
        normals.append((r / length, y / length))
    return normals


def add_lathe(mesh, material, profile, segments, place=lambda p: p, turn=lambda n: n):
    """Turns a profile [(radius, height)] about the y axis; its outside lies right of the way.

    The profile is smooth within: call again for a piece behind a hard edge. `place` and `turn`
    move positions and normals to where they belong.
    """
    normals = _profile_normals(profile)

    def corner(i, k):
        angle = 2.0 * math.pi * (k % segments) / segments
        c, s = math.cos(angle), math.sin(angle)
        (r, y), (nr, ny) = profile[i], normals[i]
        return (place((r * c, y, -r * s)), turn((nr * c, ny, -nr * s)), None)

    for i in range(len(profile) - 1):
        for k in range(segments):
            mesh.add_face(material, [corner(i, k), corner(i, k + 1), corner(i + 1, k + 1),
                                     corner(i + 1, k)])


def arc(center, radius, first_degrees, last_degrees, pieces):
    """Points of a circular arc for a profile; degrees from the +radius axis towards +height."""
    points = []
    for i in range(pieces + 1):
        angle = math.radians(first_degrees + (last_degrees - first_degrees) * i / pieces)
        points.append((center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)))
    return points
