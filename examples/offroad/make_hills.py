#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes hills.png, the heights of examples/offroad (16 bits, grey), and ground.png, the picture on them."""
import math
import struct
import zlib

NODES = 257                # in each direction
SIZE, HEIGHT = 48.0, 4.0   # m: as in offroad.yaml


def bell(x, width):
    return math.exp(-(x / width) ** 2)


def height(x, y):
    """m: rolling ground, a ridge from south to north with two passes, and knolls."""
    ground = 0.7 + 0.25 * math.sin(0.33 * x + 0.8) * math.cos(0.27 * y) + 0.12 * math.sin(0.71 * y + 0.4 * x)
    passes = bell(y + 9, 3.2) + bell(y - 8, 3.6)
    ridge = 2.6 * bell(x - 0.6 * math.sin(0.3 * y), 2.3) * (1 - 0.93 * min(1.0, passes))
    knolls = sum(
        high * bell(math.hypot(x - kx, y - ky), width)
        for kx, ky, high, width in [(-10, 2, 1.5, 1.5), (-9, -8, 1.3, 1.4), (-8, 10, 1.4, 1.6), (9, -3, 1.5, 1.5),
                                    (10, 7, 1.2, 1.3), (8, -12, 1.6, 1.7), (13, 1, 1.0, 1.2)])
    return ground + ridge + knolls


def slope(x, y):
    """Rise over run."""
    d = SIZE / (NODES - 1)
    return math.hypot(height(x + d, y) - height(x - d, y), height(x, y + d) - height(x, y - d)) / (2 * d)


def colour(x, y):
    """Grass where it is flat, earth, then rock where it is steep; a little brighter high up."""
    steep, bright = slope(x, y), 0.85 + 0.06 * height(x, y)
    grass, earth, rock = (96, 124, 62), (138, 112, 74), (128, 124, 118)
    first, second, at = (grass, earth, steep / 0.45) if steep < 0.45 else (earth, rock, min(1.0, (steep - 0.45) / 0.35))
    return [min(255, int(bright * (a + (b - a) * at))) for a, b in zip(first, second)]


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, width, rows, bits, colour_type):
    header = struct.pack(">IIBBBBB", width, len(rows), bits, colour_type, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def places(count):
    """m: from -SIZE / 2 to SIZE / 2."""
    return [SIZE * (i / (count - 1) - 0.5) for i in range(count)]


xs, ys = places(NODES), places(NODES)[::-1]
write_png("hills.png", NODES,
          [struct.pack(f">{NODES}H", *(round(65535 * height(x, y) / HEIGHT) for x in xs)) for y in ys], 16, 0)
xs, ys = places(192), places(192)[::-1]
write_png("ground.png", 192, [bytes(c for x in xs for c in colour(x, y)) for y in ys], 8, 2)
