# SPDX-License-Identifier: MIT
"""Parts of rover.urdf and rover.sdf, a file for each link and material, in mm and in the frame of the link. They keep
to the shapes by which the rover collides: a box of 350 x 250 x 120 mm, wheels of 60 mm."""
import math

from .surface import Surface, between, box, disc, loft, plate, revolved, ring, total


def base_team():
    """The body: a cabin behind, a low deck in front, which leaves the scanner its view."""
    cabin = loft(between([(-12, 112, 117, 26, -56, 0), (16, 112, 118, 30, -56, 0), (44, 98, 100, 30, -64, 0),
                          (58, 84, 84, 26, -70, 0)], 2),
                 bevel_bottom=2, bevel_top=5)
    deck = loft([(-20, 168, 112, 40, 4, 0), (-8, 166, 110, 40, 4, 0),
                 (-2, 158, 102, 36, 4, 0)], bevel_bottom=3, bevel_top=3, steps=4)
    fenders = total(_fender().at(x, y, -30) for x in (-120, 120) for y in (-114, 114))
    return total([cabin, deck, fenders])


def _fender(corners=10):
    """A quarter pipe over the wheel, inside of it: y from -9 to 9."""
    points, triangles = [], []
    for k in range(corners + 1):
        a = math.radians(20 + 140 * k / corners)
        for r in (58, 63):
            for y in (-9, 9):
                points.append((r * math.cos(a), y, r * math.sin(a)))
    for k in range(corners):
        i, j = 4 * k, 4 * k + 4
        for p, q in ((0, 2), (2, 3), (3, 1), (1, 0)):
            triangles += [(i + p, i + q, j + q), (i + p, j + q, j + p)]
    triangles += [(0, 1, 3), (0, 3, 2)]
    e = 4 * corners
    triangles += [(e, e + 2, e + 3), (e, e + 3, e + 1)]
    return Surface(points, triangles)


def base_frame():
    tub = loft([(-57, 140, 84, 24, 0, 0), (-40, 162, 100, 30, 0, 0),
                (-16, 168, 106, 34, 2, 0)], bevel_bottom=4, bevel_top=0)
    axles = total(disc(9, 90, 131, 1, 16).along_y().at(x, 0, -30) for x in (-120, 120)).with_mirror_y()
    rack = total(disc(3.2, -52, 52, 0, 8).along_x().at(-66, y, 66) for y in (-52, 52))
    bows = total(disc(3.2, -62, 62, 0, 8).along_y().at(x, 0, 66) for x in (-112, -20))
    feet = total(box((7, 7, 14)).at(x, y, 60) for x in (-112, -20) for y in (-52, 52))
    antenna = total([disc(5, 48, 62), disc(1.4, 60, 130, 0, 6), disc(2.6, 128, 134, 0, 6)]).at(-138, 68, 0)
    return total([tub, axles, rack, bows, feet, antenna])


def base_shell():
    """Bumpers."""
    bar = loft([(-98, 9, 10, 6), (-90, 10, 11, 7), (90, 10, 11, 7), (98, 9, 10, 6)], bevel=4).along_y()
    front = bar.mapped(lambda p: (p[0] + 165, p[1], p[2] - 34))
    back = bar.mapped(lambda p: (p[0] - 165, p[1], p[2] - 34))
    return front + back


def base_eye():
    """Windows."""
    front = loft([(-72, 4, 15, 4), (72, 4, 15, 4)], bevel=2).along_y()
    return front.pitched(0.905).at(44.5, 0, 30.5) + _side_windows().with_mirror_y()


def _side_windows():
    pane = loft([(-52, 3.5, 12, 3), (44, 3.5, 12, 3)], bevel=2).along_x()
    tilt = math.radians(40)
    c, s = math.cos(tilt), math.sin(tilt)
    return pane.mapped(lambda p: (p[0] - 58, 105.5 + c * p[1] - s * p[2], 32.5 + s * p[1] + c * p[2]))


def base_light():
    lamps = total(disc(9, 0, 4).along_x().at(172.4, y, -31) for y in (-66, 66))
    return lamps


def base_tail():
    return total(box((3, 26, 8)).at(-175.4, y, -31) for y in (-66, 66))


def number():
    back = plate(40, 40, 6).along_x().mapped(lambda p: (-p[0], -p[1], p[2])).at(-169.0, 0, 8)
    top = plate(60, 60, 9).mapped(lambda p: (p[1], -p[0], p[2])).at(-66, 0, 63.3)
    return back + top


def wheel_sole():
    """The tyre, with lugs, about y."""
    carcass = revolved([(36, -17), (50, -19), (57, -14), (57, 14), (50, 19), (36, 17)], 24)
    lugs = []
    for k in range(12):
        for side in (-1, 1):
            lug = box((5, 11, 15.5)).at(57.0, 0, side * 10.2)
            lugs.append(lug.turned(2 * math.pi * (k + (0.25 if side > 0 else -0.25)) / 12))
    return (carcass + total(lugs)).along_y()


def wheel_frame():
    """The rim, on the left as on the right."""
    rim = ring(30, 38, -17.5, 17.5, 0, 20)
    web = disc(31, -4, 4, 0, 20)
    spokes = total(box((24, 7, 24)).at(20, 0, 0).turned(2 * math.pi * k / 5) for k in range(5))
    cap = disc(10, -18.5, 18.5)
    return total([rim, web, spokes, cap]).along_y()


def laser_frame():
    """A scanner of the size of a Hokuyo URG-04LX: the rays leave at z 0."""
    foot = loft([(-64, 25, 25, 6), (-26, 25, 25, 6)], bevel=1.5)
    head = disc(19, -26, -9, 2) + disc(20, 6.5, 9)
    return foot + head


def laser_eye():
    return disc(18.5, -10, 7, 0)


def laser_light():
    return box((2, 10, 2.4)).at(25, 0, -34)


def parts():
    functions = [base_team, base_frame, base_shell, base_eye, base_light, base_tail, number, wheel_sole, wheel_frame,
                 laser_frame, laser_eye, laser_light]
    return {f.__name__: f().scaled(0.001) for f in functions}
