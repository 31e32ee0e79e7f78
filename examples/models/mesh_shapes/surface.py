# SPDX-License-Identifier: MIT
"""Surfaces of triangles, in metres. Corners are shared, so that a reader can make normals smooth."""
import math


class Surface:
    def __init__(self, points=(), triangles=(), coordinates=None):
        self.points = [tuple(p) for p in points]
        self.triangles = list(triangles)  # counter-clockwise seen from outside
        self.coordinates = coordinates  # of a picture, across and down, for each point; None: no picture

    def __add__(self, other):
        first = len(self.points)
        both = None
        if self.coordinates is not None and other.coordinates is not None:
            both = self.coordinates + other.coordinates
        return Surface(self.points + other.points,
                       self.triangles + [tuple(first + i for i in t) for t in other.triangles], both)

    def mapped(self, f, mirrors=False):
        turn = (lambda t: (t[0], t[2], t[1])) if mirrors else (lambda t: t)
        return Surface([f(p) for p in self.points], [turn(t) for t in self.triangles], self.coordinates)

    def at(self, x, y, z):
        return self.mapped(lambda p: (p[0] + x, p[1] + y, p[2] + z))

    def along_x(self):
        """What pointed along z points along x; x along y, y along z."""
        return self.mapped(lambda p: (p[2], p[0], p[1]))

    def along_y(self):
        """What pointed along z points along y; x along z, y along x."""
        return self.mapped(lambda p: (p[1], p[2], p[0]))

    def turned(self, angle):
        """About z, rad."""
        c, s = math.cos(angle), math.sin(angle)
        return self.mapped(lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]))

    def pitched(self, angle):
        """About y, rad."""
        c, s = math.cos(angle), math.sin(angle)
        return self.mapped(lambda p: (c * p[0] + s * p[2], p[1], c * p[2] - s * p[0]))

    def mirrored_y(self):
        return self.mapped(lambda p: (p[0], -p[1], p[2]), True)

    def with_mirror_y(self):
        return self + self.mirrored_y()

    def scaled(self, s):
        return self.mapped(lambda p: (s * p[0], s * p[1], s * p[2]))


def total(surfaces):
    surfaces = list(surfaces)
    out = surfaces[0]
    for s in surfaces[1:]:
        out = out + s
    return out


def outline(half_x, half_y, radius, steps):
    """A rounded rectangle about the origin, counter-clockwise; `steps` in each corner."""
    r = min(radius, half_x, half_y)
    points = []
    for quarter, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for k in range(steps + 1):
            a = (quarter + k / steps) * math.pi / 2
            points.append((sx * (half_x - r) + r * math.cos(a), sy * (half_y - r) + r * math.sin(a)))
    return points


def _stacked(rings):
    """Rings of equally many points, each counter-clockwise seen from the last, closed at both ends."""
    n = len(rings[0])
    points = [p for ring in rings for p in ring]
    triangles = []
    for i in range(len(rings) - 1):
        for k in range(n):
            a, b = i * n + k, i * n + (k + 1) % n
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    for ring, flip in ((0, True), (len(rings) - 1, False)):
        first = ring * n
        for k in range(1, n - 1):
            t = (first, first + k, first + k + 1)
            triangles.append((t[0], t[2], t[1]) if flip else t)
    return _cleaned(Surface(points, triangles))


def _cleaned(surface):
    """Equal points become one; triangles that lose their area go."""
    numbers, points, triangles = {}, [], []
    index = []
    for p in surface.points:
        key = tuple(round(c, 7) for c in p)
        if key not in numbers:
            numbers[key] = len(points)
            points.append(p)
        index.append(numbers[key])
    for t in surface.triangles:
        t = tuple(index[i] for i in t)
        if len(set(t)) == 3:
            triangles.append(t)
    return Surface(points, triangles)


def between(sections, parts):
    """The sections with others in between, on Catmull-Rom splines, so that a shell bends evenly."""
    full = [tuple(s) + (0.0,) * (6 - len(s)) for s in sections]
    out = []
    for i in range(len(full) - 1):
        a, b, c, d = (full[min(max(i + k, 0), len(full) - 1)] for k in (-1, 0, 1, 2))
        for step in range(parts):
            t = step / parts
            out.append(tuple(q + 0.5 * t * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)))
                             for p, q, r, s in zip(a, b, c, d)))
    return out + [full[-1]]


def loft(sections, bevel=0.0, steps=3, bevel_bottom=None, bevel_top=None):
    """A shell along z through rounded rectangles (z, half_x, half_y, radius[, centre_x, centre_y]), z rising. The first
    and the last are the ends; their edges are rounded by `bevel`."""
    full = [tuple(s) + (0.0,) * (6 - len(s)) for s in sections]
    bottom = bevel if bevel_bottom is None else bevel_bottom
    top = bevel if bevel_top is None else bevel_top

    def rounded(section, b, sign):
        z, hx, hy, r, cx, cy = section
        out = []
        parts = 3 if b > 4 else 2
        for k in range(parts):
            a = k / parts * math.pi / 2
            inset = b * (1 - math.sin(a))
            out.append((z - sign * b * (1 - math.cos(a)), hx - inset, hy - inset, max(r - inset, 0.05 * r), cx, cy))
        return out

    stack = list(full)
    if bottom > 0:
        z, *rest = stack[0]
        stack = rounded(stack[0], bottom, -1) + [(z + bottom, *rest)] + stack[1:]
    if top > 0:
        z, *rest = stack[-1]
        stack = stack[:-1] + [(z - top, *rest)] + rounded(stack[-1], top, 1)[::-1]
    rings = []
    for z, hx, hy, r, cx, cy in stack:
        rings.append([(cx + x, cy + y, z) for x, y in outline(hx, hy, r, steps)])
    return _stacked(rings)


def block(size, radius, steps=1, corner=None):
    """A box about the origin with round edges; `corner`: radius of those along z."""
    hx, hy, hz = (s / 2 for s in size)
    r = radius if corner is None else corner
    return loft([(-hz, hx, hy, r), (hz, hx, hy, r)], radius, steps)


def lathe(profile, corners=24):
    """A body about z: (radius, z) in rising order along its outside, from axis to axis or with flat ends."""
    rings = []
    for radius, z in profile:
        ring = []
        for k in range(corners):
            a = 2 * math.pi * k / corners
            ring.append((radius * math.cos(a), radius * math.sin(a), z))
        rings.append(ring)
    return _stacked(rings)


def _corners_of(radius):
    """How many corners a circle needs to look round."""
    return 12 if radius < 6 else 16 if radius < 14 else 20 if radius < 28 else 28


def disc(radius, low, high, bevel=0.0, corners=None, steps=1):
    """A cylinder about z with bevelled edges."""
    corners = corners or _corners_of(radius)
    profile = []
    if bevel <= 0:
        profile = [(radius, low), (radius, high)]
    else:
        for k in range(steps + 1):
            a = k / steps * math.pi / 2
            profile.append((radius - bevel * (1 - math.sin(a)), low + bevel * (1 - math.cos(a))))
        profile += [(r, low + high - z) for r, z in reversed(profile)]
    return lathe(profile, corners)


def ball(radius, rows=8, corners=16):
    profile = []
    for k in range(rows + 1):
        a = math.pi * (k / rows - 0.5)
        profile.append((0.0 if k in (0, rows) else radius * math.cos(a), radius * math.sin(a)))
    return lathe(profile, corners)


def revolved(section, corners=24):
    """A ring about z whose section has these points (radius, z), counter-clockwise with the radius to the right."""
    points, triangles = [], []
    n = len(section)
    for k in range(corners):
        a = 2 * math.pi * k / corners
        points += [(r * math.cos(a), r * math.sin(a), z) for r, z in section]
    for k in range(corners):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            c, d = (k + 1) % corners * n + i, (k + 1) % corners * n + (i + 1) % n
            triangles += [(a, c, d), (a, d, b)]
    return _cleaned(Surface(points, triangles))


def ring(inner, outer, low, high, bevel=0.0, corners=None):
    """A tube about z."""
    b, corners = bevel, corners or _corners_of(outer)
    if b <= 0:
        return revolved([(inner, low), (outer, low), (outer, high), (inner, high)], corners)
    return revolved([(inner, low + b), (inner + b, low), (outer - b, low), (outer, low + b),
                     (outer, high - b), (outer - b, high), (inner + b, high), (inner, high - b)], corners)


def box(size):
    hx, hy, hz = (s / 2 for s in size)
    return _stacked([[(hx, hy, z), (-hx, hy, z), (-hx, -hy, z), (hx, -hy, z)] for z in (-hz, hz)])


def strap(z0, r0, z1, r1, low, high, bevel=0.0, steps=3):
    """A plate about y, from a round end of radius r0 at z0 to one of radius r1 at z1 < z0, from y `low` to `high`."""
    points = []
    for k in range(2 * steps + 1):
        a = k / (2 * steps) * math.pi
        points.append((r0 * math.cos(a), z0 + r0 * math.sin(a)))
    for k in range(2 * steps + 1):
        a = (1 + k / (2 * steps)) * math.pi
        points.append((r1 * math.cos(a), z1 + r1 * math.sin(a)))
    middle = (0.0, 0.5 * (z0 + z1))

    def shrunk(b):
        length = max(r0, r1) + 0.5 * abs(z0 - z1)
        return [(middle[0] + (x - middle[0]) * (1 - b / max(r0, r1)),
                 middle[1] + (z - middle[1]) * (1 - b / length)) for x, z in points]

    levels = [(low, bevel), (low + bevel, 0.0), (high - bevel, 0.0), (high, bevel)] if bevel > 0 else [(low, 0.0),
              (high, 0.0)]
    rings = [[(x, y, z) for x, z in reversed(shrunk(b))] for y, b in levels]
    return _stacked(rings)


def plate(width, height, radius=0.0, steps=3, thickness=0.0008):
    """A plate for a picture, across along x and up along y, whose front at z 0 shows it; its rim goes down."""
    front = outline(width / 2, height / 2, radius, steps)
    n = len(front)
    points = [(x, y, 0.0) for x, y in front] + [(x, y, 0.0) for x, y in front] + [(x, y, -thickness) for x, y in front]
    triangles = [(0, k, k + 1) for k in range(1, n - 1)]
    for k in range(n):
        a, b = n + k, n + (k + 1) % n
        triangles += [(a + n, b + n, b), (a + n, b, a)]
    picture = [(0.5 + x / width, 0.5 - y / height) for x, y, _ in points[:n]]
    return Surface(points, triangles, picture + [(0.01, 0.01)] * (2 * n))
