#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes field.png, the grass and lines that field.sdf shows, ball.png, and net.obj, the net of a goal.

The field is that of KidSize (RoboCup Humanoid League, rules of 2025): 9 m x 6 m with a border of 1 m, lines 5 cm wide.
"""
import math
import struct
import zlib

PIXEL = 0.005                    # m
HALF = (5.5, 4.0)                # m: with the border
LINE = 0.05                      # m
AREAS = [(4.475, 2.975, 0.0),    # half lengths of the centre lines of a rectangle, and where in x it begins
         (4.475, 1.475, 3.525),  # goal area, 1 x 3 m
         (4.475, 2.475, 2.525)]  # penalty area, 2 x 5 m
CIRCLE, PENALTY_MARK = 0.75, 3.0  # m: radius; 1.5 m from the goal line
GRASS = ((58, 128, 52), (67, 141, 60))
WHITE = (240, 240, 236)


def off_lines(x, y):
    """m: from the nearest line, below 0 on it; x and y not below 0, by symmetry."""
    nearest = min(abs(math.hypot(x, y) - CIRCLE), x if y < AREAS[0][1] else math.hypot(x, y - AREAS[0][1])) - LINE / 2
    for end, side, start in AREAS:
        across = math.hypot(max(x - end, start - x, 0), y - side)
        along = math.hypot(x - end, max(y - side, 0))
        nearest = min(nearest, across - LINE / 2, along - LINE / 2)
        if start > 0:
            nearest = min(nearest, math.hypot(x - start, max(y - side, 0)) - LINE / 2)
    return min(nearest, math.hypot(x, y) - 0.05, math.hypot(x - PENALTY_MARK, y) - 0.05)


def field_colour(x, y):
    """Stripes of a mower, 1 m wide, and lines with soft edges."""
    white = min(1.0, max(0.0, 0.5 - off_lines(x, y) / PIXEL))
    grass = GRASS[int(x + 0.5) % 2]
    return bytes(round(g + (w - g) * white) for g, w in zip(grass, WHITE))


def ball_colour(u, v):
    """White with twelve dark patches in the corners of an icosahedron."""
    azimuth, z = 2 * math.pi * u, math.cos(math.pi * v)
    at = (math.cos(azimuth) * math.sqrt(1 - z * z), math.sin(azimuth) * math.sqrt(1 - z * z), z)
    golden = (1 + math.sqrt(5)) / 2
    length = math.hypot(1, golden)
    corners = [c for a in (1, -1) for b in (golden, -golden) for c in ((0, a, b), (a, b, 0), (b, 0, a))]
    angle = math.acos(min(1.0, max(sum(p * q for p, q in zip(at, c)) / length for c in corners)))
    white = min(1.0, max(0.0, (angle - 0.34) / 0.03))
    return bytes(round(30 + 212 * white) for _ in range(3))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, width, rows):
    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def write_field(path):
    columns, lines = (round(half / PIXEL) for half in HALF)
    quadrant = []  # from the middle outwards
    for row in range(lines):
        right = [field_colour((c + 0.5) * PIXEL, (row + 0.5) * PIXEL) for c in range(columns)]
        quadrant.append(b"".join(right[::-1] + right))
    write_png(path, 2 * columns, quadrant[::-1] + quadrant)


def write_net(path):
    """Strings, 1 cm wide, of a goal that opens to -x, its posts at x = 0, in a frame on the ground."""
    wide, high, depth, mesh, half = 2.7, 1.25, 0.6, 0.12, 0.005
    vertices, faces = [], []

    def strip(start, end, aside):
        first = len(vertices) + 1
        vertices.extend([[p + sign * half * a for p, a in zip(point, aside)]
                         for point, sign in ((start, -1), (start, 1), (end, 1), (end, -1))])
        faces.extend([(first, first + 1, first + 2, first + 3), (first + 3, first + 2, first + 1, first)])

    top, slope = 0.25, math.hypot(depth - 0.25, high)  # the roof is 0.25 m deep, from there the net falls to the back
    down = ((depth - top) / slope, 0, -high / slope)
    for i in range(round(wide / mesh) + 1):
        y = -wide / 2 + wide * i / round(wide / mesh)
        strip((0, y, high), (top, y, high), (0, 1, 0))
        strip((top, y, high), (depth, y, 0), (0, 1, 0))
    for i in range(round(slope / mesh) + 1):
        s = slope * i / round(slope / mesh)
        x, z = top + s * down[0], high + s * down[2]
        strip((x, -wide / 2, z), (x, wide / 2, z), down)
        for y in (-wide / 2, wide / 2):
            strip((0, y, z), (x, y, z), (0, 0, 1))
    for i in range(1, 5):
        x = depth * i / 5
        upper = high if x < top else high * (depth - x) / (depth - top)
        for y in (-wide / 2, wide / 2):
            strip((x, y, 0), (x, y, upper), (1, 0, 0))
    strip((top / 2, -wide / 2, high), (top / 2, wide / 2, high), (1, 0, 0))
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v " + " ".join(f"{c:.4f}" for c in v) + "\n" for v in vertices)
        file.writelines("f " + " ".join(map(str, f)) + "\n" for f in faces)


write_field("field.png")
write_png("ball.png", 256, [b"".join(ball_colour((c + 0.5) / 256, (r + 0.5) / 128) for c in range(256)) for r in range(128)])
write_net("net.obj")
