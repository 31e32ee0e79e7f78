# SPDX-License-Identifier: MIT
"""Pictures of numbers: dark digits on white, drawn with round strokes, as PNG of 16 greys."""
import math
import struct
import zlib

SIZE = 128  # pixels
TILE = 8


def _arc(x, y, rx, ry, first, last, steps=16):
    """Points of an ellipse; degrees, 0 is right, 90 is up."""
    out = []
    for k in range(steps + 1):
        a = math.radians(first + (last - first) * k / steps)
        out.append((x + rx * math.cos(a), y + ry * math.sin(a)))
    return out


# Strokes in a box of 1 x 2, y up.
DIGITS = {
    "0": [_arc(0.5, 1.5, 0.5, 0.5, 0, 180) + _arc(0.5, 0.5, 0.5, 0.5, 180, 360) + [(1, 1.5)]],
    "1": [[(0.2, 1.6), (0.6, 2), (0.6, 0)]],
    "2": [_arc(0.5, 1.5, 0.5, 0.5, 165, -35) + [(0, 0), (1, 0)]],
    "3": [_arc(0.5, 1.52, 0.46, 0.48, 150, -90) + _arc(0.5, 0.52, 0.5, 0.52, 90, -150)],
    "4": [[(0.75, 0), (0.75, 2), (0, 0.6), (1.05, 0.6)]],
    "5": [[(0.92, 2), (0.12, 2), (0.05, 1.08)] + _arc(0.46, 0.64, 0.54, 0.64, 125, -145)],
    "6": [_arc(0.9, 0.62, 0.9, 1.38, 100, 178) + _arc(0.5, 0.55, 0.5, 0.55, 180, -180)],
    "7": [[(0, 2), (1, 2), (0.35, 0)]],
    "8": [_arc(0.5, 1.53, 0.42, 0.47, -90, 270), _arc(0.5, 0.53, 0.5, 0.53, 90, 450)],
    "9": [_arc(0.1, 1.38, 0.9, 1.38, -80, -2) + _arc(0.5, 1.45, 0.5, 0.55, 0, 360)],
}


def _distance(x, y, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    t = 0.0 if square == 0 else min(1.0, max(0.0, ((x - a[0]) * dx + (y - a[1]) * dy) / square))
    return math.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


def _lines(number):
    text = str(number)
    height = 0.64  # of the picture
    unit = height / 2
    wide = unit if len(text) == 1 else 0.8 * unit
    gap = 0.6 * wide
    left = 0.5 - (len(text) * wide + (len(text) - 1) * gap) / 2
    lines = []
    for k, digit in enumerate(text):
        for stroke in DIGITS[digit]:
            points = [(left + k * (wide + gap) + wide * x, 0.5 - height / 2 + unit * y) for x, y in stroke]
            lines += list(zip(points, points[1:]))
    return lines


def png(number):
    lines = _lines(number)
    half = 0.055 if number < 10 else 0.048
    grey = [[15] * SIZE for _ in range(SIZE)]
    reach = 0.75 * TILE / SIZE  # more than half the diagonal of a tile
    for tile in range((SIZE // TILE) ** 2):
        top, left = tile // (SIZE // TILE) * TILE, tile % (SIZE // TILE) * TILE
        x, y = (left + TILE / 2) / SIZE, 1 - (top + TILE / 2) / SIZE
        near = [line for line in lines if _distance(x, y, *line) < half + reach + 1 / SIZE]
        if not near:
            continue
        for j in range(top, top + TILE):
            for i in range(left, left + TILE):
                d = min(_distance((i + 0.5) / SIZE, 1 - (j + 0.5) / SIZE, *line) for line in near)
                light = min(1.0, max(0.0, (d - half) * SIZE + 0.5))
                grey[j][i] = 1 + int(14 * light + 0.5)
    rows = b"".join(b"\0" + bytes(row[i] << 4 | row[i + 1] for i in range(0, SIZE, 2)) for row in grey)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    # Stored, not compressed: releases of zlib compress differently.
    stored = b"\x78\x01" + struct.pack("<BHH", 1, len(rows), len(rows) ^ 0xFFFF) + rows
    stored += struct.pack(">I", zlib.adler32(rows))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 4, 0, 0, 0, 0)) +
            chunk(b"IDAT", stored) + chunk(b"IEND", b""))
