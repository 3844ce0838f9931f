"""PNG files out of the pixmaps that csgpicture writes, side by side, with nothing but the standard
library."""
import pathlib
import struct
import zlib

GAP = 8


def read_pixmap(path):
    """(width, height, rows) of a binary PPM."""
    magic, size, depth, data = pathlib.Path(path).read_bytes().split(b"\n", 3)
    if magic != b"P6" or depth != b"255":
        raise ValueError(f"{path} is no pixmap of 8 bits")
    width, height = (int(n) for n in size.split())
    return width, height, [data[3 * width * y:3 * width * (y + 1)] for y in range(height)]


def write_png(path, panels):
    """The pixmaps `panels`, a list of rows of paths, as one picture."""
    lines, width = [], 0
    for row in panels:
        images = [read_pixmap(p) for p in row]
        height = max(h for _, h, _ in images)
        if lines:
            lines.extend([b""] * GAP)
        for y in range(height):
            parts = [rows[y] if y < h else b"\xff" * (3 * w) for w, h, rows in images]
            lines.append((b"\xff" * (3 * GAP)).join(parts))
        width = max(width, len(lines[-1]))
    # Each line less the one above compresses better (filter 2 of PNG).
    above, filtered = b"\0" * width, []
    for line in lines:
        line = line.ljust(width, b"\xff")
        filtered.append(b"\2" + bytes((a - b) & 255 for a, b in zip(line, above)))
        above = line

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width // 3, len(lines), 8, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                   chunk(b"IDAT", zlib.compress(b"".join(filtered), 9)) +
                                   chunk(b"IEND", b""))
