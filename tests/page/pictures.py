"""Small images for tests of pages, written with the standard library alone."""

import struct
import zlib


def write_png(file, width, height, colour):
    """8-bit RGB; colour(x, y) gives (r, g, b) of 0 to 255."""
    rows = b"".join(b"\0" + bytes(v for x in range(width) for v in colour(x, y))
                    for y in range(height))

    def chunk(kind, data):
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    with open(file, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_exr(file, width, height, channels):
    """Floats in plain scan lines; channels: name -> value(x, y)."""
    def attribute(name, kind, value):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value

    names = sorted(channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1)
                      for name in names) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = (struct.pack("<iI", 20000630, 2) + attribute("channels", "chlist", listed)
              + attribute("compression", "compression", b"\0")
              + attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
              + attribute("lineOrder", "lineOrder", b"\0")
              + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
              + attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
              + attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    size = 4 * width * len(names)
    first = len(header) + 8 * height
    with open(file, "wb") as out:
        out.write(header)
        for y in range(height):
            out.write(struct.pack("<Q", first + y * (8 + size)))
        for y in range(height):
            out.write(struct.pack("<ii", y, size))
            for name in names:
                out.write(struct.pack(f"<{width}f", *(channels[name](x, y) for x in range(width))))
