# SPDX-License-Identifier: MIT
"""Parts of quadruped_a1.urdf, a file for each link and material, in mm and in the frame of the link. Those of legs are
for the front left one; others mirror them."""
from .surface import ball, box, disc, loft, plate, ring, strap, total


def trunk_shell():
    hull = loft([(-158, 66, 40, 26, 0, 2), (-140, 82, 50, 30, 0, 2), (-90, 91, 56, 34, 0, 0), (0, 93, 57, 34, 0, 0),
                 (90, 91, 56, 34, 0, 0), (140, 82, 50, 30, 0, 2), (158, 66, 40, 26, 0, 2)], bevel=8, steps=4).along_x()
    head = loft([(150, 50, 36, 24, 0, 10), (205, 52, 38, 26, 0, 14), (238, 48, 35, 26, 0, 16),
                 (258, 36, 26, 20, 0, 18)],
                bevel=6, steps=4).along_x()
    return hull + head


def trunk_team():
    saddle = loft([(-104, 52, 7, 7, 0, 54), (-92, 58, 9, 8, 0, 54), (92, 58, 9, 8, 0, 54),
                   (104, 52, 7, 7, 0, 54)], bevel=4,
                  steps=3).along_x()
    tail = loft([(-176, 30, 16, 12, 0, 14), (-154, 40, 22, 16, 0, 14)], bevel=6).along_x()
    return total([saddle, _upright(88, 94.5, 74, 25, 14, 2.5).with_mirror_y(), tail])


def _upright(low, high, half_x, half_z, radius, bevel):
    """A rounded slab on the left flank, from y `low` to `high`."""
    return loft([(low, half_z, half_x, radius), (high, half_z, half_x, radius)], bevel=0, bevel_top=bevel,
                 steps=3).along_y()


def trunk_frame():
    motors = total([disc(41, 122, 204, 4).along_x().at(0, 47, 0),
                   disc(41, -204, -122, 4).along_x().at(0, 47, 0)])
    caps = total([disc(24, 203, 209, 2).along_x().at(0, 47, 0), disc(24, -209, -203, 2).along_x().at(0, 47, 0)])
    keel = loft([(-120, 48, 6, 6, 0, -57), (120, 48, 6, 6, 0, -57)], bevel=4).along_x()
    rails = loft([(-70, 4, 4, 4, 30, 70), (70, 4, 4, 4, 30, 70)], bevel=2).along_x()
    posts = total([box((8, 6, 14)).at(x, 30, 64) for x in (-60, 60)])
    return total([(motors + caps).with_mirror_y(), keel, (rails + posts).with_mirror_y()])


def trunk_eye():
    """The visor, and the lens of the camera, whose front is camera_link."""
    visor = loft([(240, 37, 22, 18, 0, 19), (257, 34, 19, 16, 0, 19),
                  (262.5, 29, 15, 13, 0, 19)], bevel=0, bevel_top=2, steps=4).along_x()
    lens = ring(5, 8, 261, 265, 1).along_x().at(0, 0, 20)
    return visor + lens


def trunk_light():
    eyes = loft([(258, 6.5, 4, 4), (263.6, 6, 3.5, 3.5)], bevel=0, bevel_top=1).along_x().at(0, 18.5,
                 23).with_mirror_y()
    tail = box((3, 36, 5)).at(-176, 0, 16)
    return eyes + tail


def number():
    flank = plate(44, 44, 7).mapped(lambda p: (-p[0], p[2], p[1])).at(0, 95.2, 2)
    other = plate(44, 44, 7).mapped(lambda p: (p[0], -p[2], p[1])).at(0, -95.2, 2)
    top = plate(56, 56, 8).mapped(lambda p: (p[1], -p[0], p[2])).at(0, 0, 63.9)
    return total([flank, other, top])


def hip_frame():
    body = disc(43, -24, 40, 4).along_y()
    arm = disc(36, -24, 12, 3).along_x()
    return body + arm


def thigh_frame():
    motor = disc(45, -42, -2, 4).along_y()
    knee = disc(19, -14, 14, 2).along_y().at(0, 0, -200)
    return motor + knee


def thigh_shell():
    upper = disc(42, -4, 13, 4).along_y()
    beam = loft([(-196, 14, 10, 9), (-170, 17, 12.5, 10), (-100, 22, 12.5, 11), (-40, 33, 11.5, 11),
                 (-14, 38, 10.5, 10)],
                bevel=4)
    return upper + beam


def thigh_team():
    cap = disc(31, 10, 17, 3).along_y()
    stripe = loft([(11, 44, 9, 8, -98, 0), (15, 42, 7.5, 7, -98, 0)], bevel=0, bevel_top=1.2).along_y()
    return cap + stripe


def thigh_servo():
    """The hub, and the screw of the knee."""
    hub = disc(14, 16, 20).along_y()
    bolts = total([disc(3, 16, 18.4, 0, 8).along_y().at(22.5 * c, 0, 22.5 * d) for c, d in ((1, 0), (-1, 0),
                  (0, 1), (0, -1))])
    return hub + bolts


def calf_frame():
    fork = (strap(0, 15, -48, 11, 10, 13.5)).with_mirror_y()
    shank = loft([(-196, 8.5, 8.5, 8.5, 0, 0), (-150, 9.5, 9, 8, -5, 0), (-90, 12, 10, 9, -7, 0),
                  (-40, 13, 9.8, 8, -3, 0),
                  (-16, 10, 9, 7, 0, 0)], bevel=3)
    return fork + shank


def calf_shell():
    return loft([(-150, 11, 10.6, 8, -4.6, 0), (-122, 14.5, 11.6, 9, -6, 0), (-84, 16.5, 12.4, 10, -6.4, 0),
                         (-56, 15, 12.2, 10, -4.5, 0)], bevel=3)


def foot_sole():
    return ball(20, 8, 16) + disc(13, 10, 26, 0)


def parts():
    functions = [trunk_shell, trunk_team, trunk_frame, trunk_eye, trunk_light, number, hip_frame, thigh_frame,
        thigh_shell,
                 thigh_team, thigh_servo, calf_frame, calf_shell, foot_sole]
    return {f.__name__: f().scaled(0.001) for f in functions}
