"""Scene files as text: one line for each camera key, model, material and light."""

import json

from mesh import number_text


def _value(value):
    if isinstance(value, bool) or isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, (int, float)):
        return number_text(value, 9)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)}: {_value(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(_value(item) for item in value) + "]"


def _entry(value, indent):
    """A dictionary on one line, but each of its keys (of an animation) on a line of its own."""
    if not isinstance(value, dict) or "keys" not in value:
        return _value(value)
    rest = {k: v for k, v in value.items() if k != "keys"}
    pad = " " * (indent + 2)
    keys = (",\n" + pad + "  ").join(_value(key) for key in value["keys"])
    return f"{_value(rest)[:-2]},\n{pad}\"keys\": [\n{pad}  {keys} ] }}"


def _section(value):
    if isinstance(value, list):
        return "[\n    " + ",\n    ".join(_entry(item, 4) for item in value) + " ]"
    if isinstance(value, dict) and all(isinstance(item, dict) for item in value.values()):
        items = [f"{json.dumps(name)}: {_entry(item, 4)}" for name, item in value.items()]
        return "{\n    " + ",\n    ".join(items) + " }"
    return _entry(value, 2)


def write_scene(path, scene):
    sections = [f"  {json.dumps(name)}: {_section(value)}" for name, value in scene.items()]
    path.write_text("{\n" + ",\n".join(sections) + "\n}\n")
