"""Writes textured-wall/: a brick wall and a glossy plank floor with procedural maps."""

import math
from pathlib import Path

from material_text import material_lines, write_materials
from mesh import Mesh, add_box, add_lathe, arc
from placement import axes_facing
from png import write_png
from scene_text import write_scene
from surfaces import bricks, planks

FOLDER = Path(__file__).resolve().parent.parent / "textured-wall"
COMMENT = "penumbra: made by data/scenes/make/textured_wall.py, Apache-2.0"
SIZE = 512  # texels
WALL_TILE, FLOOR_TILE = 1.0, 1.3  # metres that the maps cover
BENCH_X, BENCH_Z = -0.35, -0.30
TRELLIS_TURN = -math.degrees(math.atan2(0.056, 0.22))  # along its posts


def byte(value):
    return min(max(int(value * 255.0 + 0.5), 0), 255)


def normal_bytes(heights, i, j):
    """Tangent-space normal as in glTF 2.0: red along u, green along v (up in the picture)."""
    slope_u = (heights[j][(i + 1) % SIZE] - heights[j][i - 1]) * SIZE / 2
    slope_v = (heights[j - 1][i] - heights[(j + 1) % SIZE][i]) * SIZE / 2
    length = math.sqrt(slope_u * slope_u + slope_v * slope_v + 1.0)
    return [byte(0.5 - 0.5 * slope_u / length), byte(0.5 - 0.5 * slope_v / length),
            byte(0.5 + 0.5 / length)]


def write_maps(name, surface):
    texels = [[surface((i + 0.5) / SIZE, 1.0 - (j + 0.5) / SIZE) for i in range(SIZE)]
              for j in range(SIZE)]
    heights = [[texel[0] for texel in row] for row in texels]
    colors = [bytes(byte(value) for texel in row for value in texel[1]) for row in texels]
    roughness = [bytes(byte(texel[2]) for texel in row) for row in texels]
    normals = [bytes(value for i in range(SIZE) for value in normal_bytes(heights, i, j))
               for j in range(SIZE)]
    write_png(FOLDER / f"{name}_color.png", SIZE, 3, colors)
    write_png(FOLDER / f"{name}_normal.png", SIZE, 3, normals)
    write_png(FOLDER / f"{name}_roughness.png", SIZE, 1, roughness)


def add_textured(mesh, material, corners, columns, rows):
    """`columns` x `rows` repetitions of the maps."""
    uvs = [(0, 0), (columns, 0), (columns, rows), (0, rows)]
    mesh.add_flat_face(material, corners, uvs)


def add_bench(mesh):
    """Slats on two frames: narrow gaps, and shadows of many widths."""
    for i in range(4):
        add_box(mesh, "oak", (BENCH_X, 0.47, BENCH_Z - 0.18 + 0.12 * i), (0.75, 0.018, 0.038))
    for x in (BENCH_X - 0.6, BENCH_X + 0.6):
        add_box(mesh, "iron", (x, 0.438, BENCH_Z), (0.02, 0.014, 0.23))
        for z in (BENCH_Z - 0.19, BENCH_Z + 0.19):
            add_box(mesh, "iron", (x, 0.212, z), (0.02, 0.212, 0.02))


def add_trellis(mesh):
    """Stands 12 to 40 cm before the wall: its shadow softens with the distance."""
    for i in range(6):
        x = 0.62 + 0.22 * i
        add_box(mesh, "oak", (x, 0.95, -0.88 + 0.056 * i), (0.014, 0.95, 0.014))
    for i in range(7):
        add_box(mesh, "oak", (1.17, 0.22 + 0.26 * i, -0.712), (0.60, 0.014, 0.012), TRELLIS_TURN)


def add_vase(mesh, x, z, scale):
    """Closed: foot, belly, lip and an inside."""
    def place(p):
        return (x + scale * p[0], scale * p[1], z + scale * p[2])

    belly = [(0.062, 0.0)] + arc((0.02, 0.17), 0.13, -62, 58, 20) + [(0.055, 0.32), (0.050, 0.36)]
    lip = arc((0.062, 0.385), 0.014, 180, 0, 8)
    inside = [(0.076, 0.385), (0.042, 0.34), (0.040, 0.30), (0.10, 0.17), (0.0, 0.03)]
    add_lathe(mesh, "glaze", [(0.0, 0.0), (0.062, 0.0)], 64, place)
    add_lathe(mesh, "glaze", belly + lip, 64, place)
    add_lathe(mesh, "glaze", inside, 64, place)


def write_model():
    mesh = Mesh()
    add_textured(mesh, "planks", [(-4, 0, 4), (4, 0, 4), (4, 0, -1), (-4, 0, -1)],
                 8 / FLOOR_TILE, 5 / FLOOR_TILE)
    add_textured(mesh, "bricks", [(-4, 0, -1), (4, 0, -1), (4, 3.5, -1), (-4, 3.5, -1)],
                 8 / WALL_TILE, 3.5 / WALL_TILE)
    add_bench(mesh)
    add_trellis(mesh)
    add_vase(mesh, 0.92, 0.22, 1.25)
    add_vase(mesh, -1.50, -0.35, 1.9)
    mesh.write(FOLDER / "textured-wall.obj", COMMENT, "textured-wall.mtl")
    write_materials(FOLDER / "textured-wall.mtl", COMMENT, [
        mapped_material("planks"), mapped_material("bricks"),
        material_lines("oak", (0.42, 0.27, 0.15), 0.4),
        material_lines("iron", (0.05, 0.05, 0.055), 0.35),
        material_lines("glaze", (0.10, 0.25, 0.33), 0.15)])


def mapped_material(name):
    """Maps multiply their factor, which is therefore 1."""
    return material_lines(name, (1, 1, 1), 1, 0, [
        ("map_Kd", f"{name}_color.png"), ("map_Pr", f"{name}_roughness.png"),
        ("norm", f"{name}_normal.png")])


def scene():
    position = (-1.9, 2.3, 2.2)
    u, v = axes_facing(position, (0.2, 0.5, -0.6), 0.16, 0.26)
    return {
        "film": {"size": [1920, 1080]},
        "camera": {"eye": [0.55, 1.25, 3.3], "target": [-0.02, 0.72, -0.4], "up": [0, 1, 0],
                   "vfov": 38},
        "models": [{"name": "room", "file": "textured-wall.obj"}],
        "lights": [{"name": "window", "type": "rect", "center": position, "u": u, "v": v,
                    "radiance": [330, 290, 240]}],
        "animation": {"fps": 24, "frames": [1, 1]},
        "render": {"spp": 1}}


def main():
    FOLDER.mkdir(exist_ok=True)
    write_maps("bricks", bricks)
    write_maps("planks", planks)
    write_model()
    write_scene(FOLDER / "textured-wall.json", scene())


if __name__ == "__main__":
    main()
