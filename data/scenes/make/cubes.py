"""Writes cubes/: one set of cubes under lights of increasing size and equal power.

The set-up follows the comparison of light sizes in Heitz, Hill and McGuire, "Combining Analytic
Direct Illumination and Stochastic Shadows" (2018), section 5; the arrangement is ours.
"""

from pathlib import Path

from material_text import material_lines, write_materials
from mesh import Mesh, add_box
from placement import axes_facing
from scene_text import write_scene

FOLDER = Path(__file__).resolve().parent.parent / "cubes"
COMMENT = "penumbra: made by data/scenes/make/cubes.py, Apache-2.0"

CUBES = [  # material, x, height of the underside, z, half edge, degrees about y
    ("clay", -1.15, 0.0, 0.15, 0.42, 24),
    ("chalk", -1.08, 0.84, 0.12, 0.24, 51),
    ("chalk", 0.10, 0.0, -0.70, 0.55, -12),
    ("slate", 0.26, 1.10, -0.66, 0.30, 33),
    ("clay", 0.18, 1.70, -0.62, 0.15, 8),
    ("slate", 0.62, 0.0, 0.74, 0.26, 40),
    ("chalk", 1.50, 0.0, -0.15, 0.34, 62),
    ("clay", -0.30, 0.0, 0.86, 0.15, 15),
    ("slate", -0.62, 0.0, 1.42, 0.10, 66),
    ("chalk", 1.28, 0.0, 1.06, 0.12, 20),
    ("slate", -2.10, 0.0, -0.95, 0.36, 10),
    ("clay", 2.35, 0.0, -1.20, 0.45, 37),
]
LIGHT_POSITION, LIGHT_TARGET = (-2.6, 3.9, 1.5), (0.0, 0.3, 0.0)
LIGHT_SIZES = {"small": 0.06, "medium": 0.35, "large": 1.2}  # half edges in metres
LIGHT_POWER = 75.0  # radiance times area, W/sr


def write_model():
    mesh = Mesh()
    mesh.add_flat_face("floor", [(-12, 0, 12), (12, 0, 12), (12, 0, -3.2), (-12, 0, -3.2)])
    mesh.add_flat_face("floor", [(-12, 0, -3.2), (12, 0, -3.2), (12, 7, -3.2), (-12, 7, -3.2)])
    for material, x, bottom, z, half, degrees in CUBES:
        add_box(mesh, material, (x, bottom + half, z), (half, half, half), degrees)
    mesh.write(FOLDER / "cubes.obj", COMMENT, "cubes.mtl")
    write_materials(FOLDER / "cubes.mtl", COMMENT, [
        material_lines("floor", (0.55, 0.54, 0.52), 0.4),
        material_lines("chalk", (0.78, 0.76, 0.72), 0.8),
        material_lines("clay", (0.62, 0.27, 0.15), 0.45),
        material_lines("slate", (0.16, 0.24, 0.31), 0.25)])


def scene(half_edge):
    u, v = axes_facing(LIGHT_POSITION, LIGHT_TARGET, half_edge, half_edge)
    radiance = LIGHT_POWER / (4 * half_edge * half_edge)
    tint = (1.0, 0.93, 0.84)
    return {
        "film": {"size": [1920, 1080]},
        "camera": {"eye": [1.0, 2.7, 5.6], "target": [0.05, 0.62, 0.1], "up": [0, 1, 0],
                   "vfov": 34},
        "models": [{"name": "cubes", "file": "cubes.obj"}],
        "lights": [{"name": "key", "type": "rect", "center": LIGHT_POSITION, "u": u, "v": v,
                    "radiance": [round(radiance * value, 4) for value in tint]}],
        "animation": {"fps": 24, "frames": [1, 1]},
        "render": {"spp": 1}}


def main():
    FOLDER.mkdir(exist_ok=True)
    write_model()
    for name, half_edge in LIGHT_SIZES.items():
        write_scene(FOLDER / f"cubes-{name}.json", scene(half_edge))


if __name__ == "__main__":
    main()
