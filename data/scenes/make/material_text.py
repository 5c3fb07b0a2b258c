"""MTL files with the physically based extension (Pr, Pm, map_Pr, norm)."""

from mesh import number_text


def material_lines(name, base_color, roughness, metallic=0.0, maps=()):
    """`maps` are (keyword, file) pairs such as ("map_Kd", "brick.png")."""
    color = " ".join(number_text(value, 5) for value in base_color)
    lines = [f"newmtl {name}", f"Kd {color}", f"Pr {number_text(roughness, 4)}",
             f"Pm {number_text(metallic, 4)}"]
    return lines + [f"{keyword} {file}" for keyword, file in maps] + [""]


def write_materials(path, comment, materials):
    """`materials` is a list of material_lines' results."""
    lines = [f"# {comment}", ""]
    for material in materials:
        lines += material
    path.write_text("\n".join(lines))
