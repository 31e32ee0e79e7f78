# SPDX-License-Identifier: MIT
"""Parts of soccer_omni.urdf, a file for each link and material, in mm and in the frame of the link: base_link is 27 mm
above the floor, at the height of the wheels' axes."""
import math

from .surface import Surface, box, disc, lathe, loft, ring, total

RADIUS = 88
FLAT = 72  # the front, behind the dribbler
WHEELS = (60, 135, -135, -60)  # degrees


def _hull(low, high, inset=0.0, bevel=0.0, flat=FLAT, corners=48):
    """A cylinder with a flat front, from z `low` to `high`; edges cut by `bevel`."""
    def ring_of(b, z):
        points = []
        r = RADIUS - inset - b
        for k in range(corners):
            a = 2 * math.pi * k / corners
            points.append((min(r * math.cos(a), flat - inset - b), r * math.sin(a), z))
        return points
    rings = [ring_of(0, low), ring_of(0, high)]
    if bevel > 0:
        rings = [ring_of(0, low), ring_of(0, high - bevel), ring_of(0.3 * bevel, high - 0.3 * bevel),
                         ring_of(bevel, high)]
    n = corners
    points = [p for r in rings for p in r]
    triangles = []
    for i in range(len(rings) - 1):
        for k in range(n):
            a, b = i * n + k, i * n + (k + 1) % n
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    last = (len(rings) - 1) * n
    for k in range(1, n - 1):
        triangles += [(0, k + 1, k), (last, last + k, last + k + 1)]
    return Surface(points, triangles)


def base_shell():
    return _hull(36, 116, bevel=7)


def base_team():
    """The marker of the vision system in the middle of the top, and a belt."""
    marker = disc(25, 115, 117.2)
    belt = _hull(48, 60, inset=-0.9)
    return marker + belt


def base_light():
    """The other four markers, which tell robots of a team apart for the vision system."""
    return total(disc(20, 115, 116.8).at(53 * math.cos(math.radians(a)), 53 * math.sin(math.radians(a)), 0)
                 for a in (40, 140, -140, -40))


def base_frame():
    floor = _hull(-17, -11, inset=7, flat=70)
    deck = _hull(30, 37, inset=3, flat=70)
    middle = disc(44, -12, 31, 0).at(-6, 0, 0)
    motors = total(disc(16, 22, 56).along_x().turned(math.radians(a)) for a in WHEELS)
    posts = total(box((9, 9, 44)).at(x, y, 10) for x, y in ((60, 31), (60, -31), (-78, 12), (-78, -12)))
    return total([floor, deck, middle, motors, posts])


def base_servo():
    """The kicker's plate with its plunger, and the arms of the dribbler."""
    kicker = box((4, 52, 17)).at(66, 0, -4) + disc(5, 40, 65, 1, 16).along_x().at(0, 0, -3)
    arms = total(loft([(y - 3, 11, 8, 6, 14, 76), (y + 3, 11, 8, 6, 14, 76)], bevel=1).along_y() for y in (-36, 36))
    return kicker + arms


def base_sole():
    """The dribbler's roller: rubber, grooved to draw the ball to the middle."""
    profile = []
    for k in range(17):
        y = -32 + 4 * k
        profile.append((5.2 if k % 2 else 6.6, y))
    return lathe([(3, -34)] + profile + [(3, 34)], 16).along_y().at(77, 0, 14)


def base_eye():
    """A dark window in front, for the barrier of light that sees the ball, and the charger's grille behind."""
    window = box((3, 46, 14)).at(71.5, 0, 86)
    lens = ring(3.5, 7, 72, 75, 1).along_x().at(0, 0, 86) + disc(3.6, 72, 73.6, 0).along_x().at(0, 0, 86)
    return window + lens


def number():
    """On the round back."""
    size, columns, z = 44, 10, 87
    points, at, triangles = [], [], []
    r = RADIUS + 0.7
    for i in range(columns + 1):
        across = i / columns
        angle = math.pi + (across - 0.5) * size / r
        for down in (0, 1):
            points.append((r * math.cos(angle), r * math.sin(angle), z + size * (0.5 - down)))
            at.append((across, float(down)))
    for i in range(columns):
        a = 2 * i
        triangles += [(a, a + 1, a + 3), (a, a + 3, a + 2)]
    return Surface(points, triangles, at)


def wheel_frame():
    """The hub: two discs that hold the rollers, about x."""
    plates = ring(6, 21.5, -6.5, -4.5) + ring(6, 21.5, 4.5, 6.5)
    hub = disc(7.5, -8.5, 8.5)
    spokes = total(box((15, 3, 9)).at(13, 0, 0).turned(2 * math.pi * k / 6) for k in range(6))
    return total([plates, hub, spokes]).along_x()


def wheel_sole():
    """The rollers, whose outside is the wheel's circle of 27 mm."""
    count = 15
    roller = lathe([(2.7, -4.6), (4.1, 0), (2.7, 4.6)], 8)  # about z, the direction of travel
    placed = roller.mapped(lambda p: (p[0], p[2], -p[1])).at(22.9, 0, 0)  # about y, at the rim on x
    return total(placed.turned(2 * math.pi * k / count) for k in range(count)).along_x()


def parts():
    functions = [base_shell, base_team, base_light, base_frame, base_servo, base_sole, base_eye, number, wheel_frame,
        wheel_sole]
    return {f.__name__: f().scaled(0.001) for f in functions}
