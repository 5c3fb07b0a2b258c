"""Writes turntable/, the built-in scene: a teapot among turning hoops in a colonnade, 48 frames."""

import math
from pathlib import Path

import architecture
from material_text import material_lines, write_materials
from mesh import Mesh
from placement import axes_facing
from scene_text import write_scene
from teapot_mesh import add_teapot

FOLDER = Path(__file__).resolve().parent.parent / "turntable"
COMMENT = "penumbra: made by data/scenes/make/turntable.py, Apache-2.0"

FRAMES, RATE = 48, 24
DRUM_TOP, PEDESTAL_TOP = 0.18, 0.82
COLUMNS, COLUMN_DISTANCE, COLUMN_HEIGHT, COLUMN_RADIUS = 11, 3.6, 2.9, 0.13
ARC = 105.0  # degrees from the middle to the last column
MATERIALS = [
    ("wall", (0.20, 0.23, 0.27), 0.80, 0), ("floor", (0.36, 0.35, 0.34), 0.48, 0),
    ("inlay", (0.83, 0.60, 0.29), 0.35, 1), ("drum", (0.46, 0.44, 0.42), 0.5, 0),
    ("pedestal", (0.12, 0.13, 0.15), 0.20, 0), ("column", (0.72, 0.68, 0.61), 0.65, 0),
    ("brass", (0.88, 0.66, 0.33), 0.42, 1), ("lacquer", (0.50, 0.05, 0.04), 0.22, 0),
    ("porcelain", (0.78, 0.75, 0.70), 0.18, 0)]


def stage():
    mesh = Mesh(position_digits=4)
    architecture.add_room(mesh, 9.0, 8.0, 1.2)
    architecture.add_drum(mesh, 2.0, DRUM_TOP, 0.04)
    architecture.add_pedestal(mesh, DRUM_TOP, PEDESTAL_TOP)
    return mesh


def colonnade():
    mesh = Mesh(position_digits=4)
    for i in range(COLUMNS):
        azimuth = ARC * (2 * i / (COLUMNS - 1) - 1)
        architecture.add_column(mesh, azimuth, COLUMN_DISTANCE, COLUMN_HEIGHT, COLUMN_RADIUS)
    distances = (COLUMN_DISTANCE - 0.15, COLUMN_DISTANCE + 0.15)
    heights = (COLUMN_HEIGHT, COLUMN_HEIGHT + 0.16)
    architecture.add_beam(mesh, "column", distances, heights, (-ARC - 4, ARC + 4), 64)
    return mesh


def halo():
    mesh = Mesh(position_digits=4)
    architecture.add_lattice_hoop(mesh, 1.30, 0.15, 40)
    return mesh


def hoop():
    mesh = Mesh(position_digits=4)
    architecture.add_hoop(mesh, "lacquer", 1.62, 0.0, 0.045, 0.014)
    return mesh


def teapot():
    mesh = Mesh(position_digits=4)
    add_teapot(mesh, "porcelain", 10)
    return mesh


def write_models():
    for part in (stage, colonnade, halo, hoop, teapot):
        part().write(FOLDER / f"{part.__name__}.obj", COMMENT, "turntable.mtl")
    write_materials(FOLDER / "turntable.mtl", COMMENT,
                    [material_lines(*material) for material in MATERIALS])


def turning(tilt, turns):
    """A full turn about the vertical of a hoop that is tilted; ends where it began."""
    duration = FRAMES / RATE
    return [{"time": duration * i / 4, "rotate": [tilt, turns * 90.0 * i, 0]} for i in range(5)]


def camera():
    """A slow arc about the middle, rising, with straight pieces of four frames."""
    keys = []
    for frame in range(0, FRAMES + 1, 4):
        t = frame / FRAMES
        ease = t * t * (3 - 2 * t)
        azimuth = math.radians(-20 + 34 * ease)
        distance, height = 7.6 - 0.4 * ease, 2.5 + 1.0 * ease
        eye = [round(distance * math.sin(azimuth), 4), round(height, 4),
               round(distance * math.cos(azimuth), 4)]
        keys.append({"time": frame / RATE, "eye": eye})
    return {"eye": keys[0]["eye"], "target": [0, 1.2, 0], "up": [0, 1, 0], "vfov": 33,
            "keys": keys}


def rect(name, position, target, half_size, radiance):
    u, v = axes_facing(position, target, *half_size)
    return {"name": name, "type": "rect", "center": position, "u": u, "v": v, "radiance": radiance}


def scene():
    return {
        "film": {"size": [1920, 1080]},
        "camera": camera(),
        "models": [
            {"name": "stage", "file": "stage.obj"},
            {"name": "colonnade", "file": "colonnade.obj"},
            {"name": "teapot", "file": "teapot.obj", "scale": 0.27, "rotate": [0, -24, 0],
             "translate": [0, PEDESTAL_TOP, 0]},
            {"name": "halo", "file": "halo.obj", "rotate": [17, 0, 0], "translate": [0, 2.2, 0],
             "keys": turning(17, 1)},
            {"name": "hoop", "file": "hoop.obj", "rotate": [-5, 0, 0],
             "translate": [0, 0.86, 0], "keys": turning(-5, -1)}],
        "lights": [
            rect("evening", (-2.5, 2.72, -5.7), (0.2, 0.4, 0.8), (0.13, 0.13), [3000, 1700, 810]),
            rect("lamp", (0.02, 5.2, 0.03), (0, 0, 0), (0.28, 0.28), [92, 86, 77]),
            rect("window", (4.9, 4.6, 4.6), (0, 0.9, -0.5), (1.5, 1.1), [4.6, 7.0, 10.6])],
        "animation": {"fps": RATE, "frames": [1, FRAMES]},
        "render": {"spp": 1}}


def main():
    FOLDER.mkdir(exist_ok=True)
    write_models()
    write_scene(FOLDER / "turntable.json", scene())


if __name__ == "__main__":
    main()
