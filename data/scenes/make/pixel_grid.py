"""Writes pixel-grid/: edges and corners that lie exactly on the centres of pixels.

The camera looks straight at the wall from as far as it is high above the frame's middle, so that one
unit on the wall is one pixel. Which triangle owns a pixel is decided by the fill rule alone.
"""

from pathlib import Path

from material_text import material_lines, write_materials
from mesh import Mesh
from scene_text import write_scene

FOLDER = Path(__file__).resolve().parent.parent / "pixel-grid"
COMMENT = "penumbra: made by data/scenes/make/pixel_grid.py, Apache-2.0"
SIZE = 64  # pixels
DISTANCE = SIZE / 2  # of the eye from the wall: with 90 degrees a unit is a pixel
CELL = 6
KITE_HEIGHT = 8.0  # before the wall; a pixel is smaller there
KITES = [(-14, 11), (9, 13), (-9, -12), (16, -7)]  # pixels from the middle
KITE_RADIUS = 5


def on_center(x, y, height=0.0):
    """The point `height` before the wall that is seen at the centre of a pixel."""
    scale = (DISTANCE - height) / DISTANCE
    return ((x + 0.5) * scale, (y + 0.5) * scale, height)


def add_cell(mesh, x, y):
    """Two triangles, the diagonal running the other way in every other cell."""
    corners = [on_center(x, y), on_center(x + CELL, y), on_center(x + CELL, y + CELL),
               on_center(x, y + CELL)]
    is_odd = (x + y) // CELL % 2
    if is_odd:
        corners = corners[1:] + corners[:1]
    a, b, c, d = corners
    mesh.add_flat_face("dark" if is_odd else "bright", [a, b, c])
    mesh.add_flat_face("dark" if is_odd else "bright", [a, c, d])


def add_kite(mesh, x, y):
    """A fan around its middle: many triangles meet on one centre."""
    reach = [(KITE_RADIUS, 0), (2, 2), (0, KITE_RADIUS), (-2, 2),
             (-KITE_RADIUS, 0), (-2, -2), (0, -KITE_RADIUS), (2, -2)]
    rim = [on_center(x + dx, y + dy, KITE_HEIGHT) for dx, dy in reach]
    middle = on_center(x, y, KITE_HEIGHT)
    for i, corner in enumerate(rim):
        mesh.add_flat_face("kite", [middle, corner, rim[(i + 1) % len(rim)]])


def main():
    FOLDER.mkdir(exist_ok=True)
    mesh = Mesh()
    reach = range(-5 * CELL, 5 * CELL, CELL)
    for y in reach:
        for x in reach:
            add_cell(mesh, x, y)
    for x, y in KITES:
        add_kite(mesh, x, y)
    mesh.write(FOLDER / "pixel-grid.obj", COMMENT, "pixel-grid.mtl")
    write_materials(FOLDER / "pixel-grid.mtl", COMMENT, [
        material_lines("bright", (0.75, 0.72, 0.66), 0.6),
        material_lines("dark", (0.24, 0.30, 0.36), 0.35),
        material_lines("kite", (0.78, 0.33, 0.16), 0.5)])
    write_scene(FOLDER / "pixel-grid.json", {
        "film": {"size": [SIZE, SIZE]},
        "camera": {"eye": [0, 0, DISTANCE], "target": [0, 0, 0], "up": [0, 1, 0], "vfov": 90},
        "models": [{"name": "wall", "file": "pixel-grid.obj"}],
        "lights": [
            {"name": "left", "type": "rect", "center": [-30, 24, 26], "u": [4, 0, 5],
             "v": [2.5, 4, -2], "radiance": [34, 30, 25], "visible": False, "two_sided": True},
            {"name": "right", "type": "rect", "center": [34, 6, 20], "u": [2, 0, -3],
             "v": [0, 5, 0], "radiance": [9, 12, 16], "visible": False, "two_sided": True}],
        "animation": {"fps": 24, "frames": [1, 1]},
        "render": {"spp": 1}})


if __name__ == "__main__":
    main()
