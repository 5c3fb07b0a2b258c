"""Writes teapot/: Newell's teapot on a ground plane under two polygon lights."""

from pathlib import Path

from material_text import material_lines, write_materials
from mesh import Mesh
from placement import polygon_facing
from scene_text import write_scene
from teapot_mesh import add_teapot

FOLDER = Path(__file__).resolve().parent.parent / "teapot"
COMMENT = "penumbra: made by data/scenes/make/teapot.py, Apache-2.0"
PIECES = 16  # quadrangles along each side of a patch


def write_models():
    teapot = Mesh(position_digits=6)
    add_teapot(teapot, "porcelain", PIECES)
    teapot.write(FOLDER / "teapot.obj", COMMENT, "teapot.mtl")
    ground = Mesh()
    ground.add_flat_face("ground", [(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)])
    ground.write(FOLDER / "ground.obj", COMMENT, "teapot.mtl")
    write_materials(FOLDER / "teapot.mtl", COMMENT, [
        material_lines("porcelain", (0.80, 0.76, 0.68), 0.22),
        material_lines("ground", (0.36, 0.37, 0.39), 0.45)])


def scene():
    return {
        "film": {"size": [1920, 1080]},
        "camera": {"eye": [0.12, 0.27, 0.48], "target": [0.02, 0.062, 0], "up": [0, 1, 0],
                   "vfov": 32},
        "models": [
            {"name": "ground", "file": "ground.obj"},
            {"name": "teapot", "file": "teapot.obj", "scale": 0.05}],
        "lights": [
            {"name": "hexagon", "type": "polygon", "radiance": [90, 74, 56],
             "vertices": polygon_facing((-0.40, 0.42, 0.30), (0, 0.06, 0), 0.07, 6)},
            {"name": "triangle", "type": "polygon", "radiance": [4.2, 5.6, 7.6],
             "vertices": polygon_facing((0.46, 0.34, -0.26), (0, 0.06, 0), 0.26, 3)}],
        "animation": {"fps": 24, "frames": [1, 1]},
        "render": {"spp": 1}}


def main():
    FOLDER.mkdir(exist_ok=True)
    write_models()
    write_scene(FOLDER / "teapot.json", scene())


if __name__ == "__main__":
    main()
