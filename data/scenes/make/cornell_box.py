"""Writes cornell-box/: the Cornell box from its published measurements, in metres."""

import math
from pathlib import Path

import cornell_data as data
from material_text import material_lines, write_materials
from mesh import Mesh, scaled
from scene_text import write_scene
from spectra import radiance_rgb, reflectance_rgb

FOLDER = Path(__file__).resolve().parent.parent / "cornell-box"
COMMENT = "penumbra: made by data/scenes/make/cornell_box.py, Apache-2.0"
METRES = 0.001
# The surfaces are Lambertian: an index of refraction close to 1 leaves next to no glossy part.
LAMBERTIAN = {"roughness": 1, "ior": 1.001}


def add_quadrangle(mesh, material, corners):
    """Two triangles: the walls are not quite planar."""
    a, b, c, d = [scaled(corner, METRES) for corner in corners]
    mesh.add_flat_face(material, [a, b, c])
    mesh.add_flat_face(material, [a, c, d])


def add_ceiling(mesh):
    """With a hole where the light is, so that nothing lies in the light's plane before it."""
    for i in range(4):
        k = (i + 1) % 4
        outer, inner = data.CEILING, data.LIGHT
        add_quadrangle(mesh, "white", [outer[i], outer[k], inner[k], inner[i]])


def add_block(mesh, top):
    """Top and four sides; the published blocks have no bottom."""
    add_quadrangle(mesh, "white", top)
    for i in range(4):
        a, b = top[i], top[(i + 1) % 4]
        add_quadrangle(mesh, "white", [(a[0], 0, a[2]), (b[0], 0, b[2]), b, a])


def write_model():
    mesh = Mesh()
    for material, corners in data.ROOM:
        add_quadrangle(mesh, material, corners)
    add_ceiling(mesh)
    add_block(mesh, data.SHORT_BLOCK_TOP)
    add_block(mesh, data.TALL_BLOCK_TOP)
    mesh.write(FOLDER / "cornell-box.obj", COMMENT, "cornell-box.mtl")
    write_materials(FOLDER / "cornell-box.mtl", COMMENT, [
        material_lines("white", reflectance_rgb(data.WHITE), 1),
        material_lines("green", reflectance_rgb(data.GREEN), 1),
        material_lines("red", reflectance_rgb(data.RED), 1)])


def light():
    corners = [scaled(corner, METRES) for corner in data.LIGHT]
    center = [(corners[0][axis] + corners[2][axis]) / 2 for axis in range(3)]
    return {"name": "ceiling", "type": "rect", "center": center,
            "u": [abs(corners[0][0] - corners[2][0]) / 2, 0, 0],
            "v": [0, 0, abs(corners[0][2] - corners[2][2]) / 2],
            "radiance": [round(value, 4) for value in radiance_rgb(data.LIGHT_EMISSION)]}


def scene():
    eye = scaled(data.CAMERA_POSITION, METRES)
    field_of_view = 2 * math.degrees(math.atan(data.SENSOR_SIZE / 2 / data.FOCAL_LENGTH))
    return {
        "film": {"size": [1024, 1024]},
        "camera": {"eye": eye, "target": [eye[0], eye[1], 0], "up": [0, 1, 0],
                   "vfov": round(field_of_view, 4)},
        "models": [{"name": "box", "file": "cornell-box.obj"}],
        "materials": {name: LAMBERTIAN for name in ("white", "green", "red")},
        "lights": [light()],
        "animation": {"fps": 24, "frames": [1, 1]},
        "render": {"spp": 1}}


def main():
    FOLDER.mkdir(exist_ok=True)
    write_model()
    write_scene(FOLDER / "cornell-box.json", scene())


if __name__ == "__main__":
    main()
