# SPDX-License-Identifier: MIT
"""Parts of humanoid.urdf, a file for each link and material, in mm and in the frame of the link. Those of arms and legs
are for the left side; the right one mirrors them."""

import math

from .surface import between, block, box, disc, loft, plate, ring, strap, total

def trunk_shell():
    chest = loft(between([(57, 34, 37, 24, -15, 0), (72, 44, 48, 28, -15, 0), (94, 49, 53.5, 30, -14.5, 0),
                          (112, 48, 53, 30, -14.5, 0), (125, 40, 47, 28, -15.5, 0), (132, 29, 37, 22, -16, 0)], 2),
                           bevel=4, steps=4)
    # over the shoulders' servos
    caps = disc(22, 36, 55, 5).along_y().at(-1, 0, 111).with_mirror_y()
    return chest + caps

def trunk_team():
    back = loft([(62, 9, 36, 9, -66, 0), (70, 11, 39, 9, -66, 0), (112, 11, 39, 9, -66, 0), (122, 9, 36, 9, -66, 0)],
                bevel=4)
    chest = loft([(20, 28, 21, 12, 0, 96), (34, 28, 21, 12, 0, 96),
                  (38.5, 24, 17.5, 10, 0, 96)], bevel=0, bevel_top=2).along_x()
    collar = ring(17, 25, 128, 135, 2).at(-1, 0, 0)
    return back + chest + collar

def trunk_frame():
    waist = disc(27, 50, 59).at(-6, 0, 0)
    neck = disc(15, 126, 137).at(-1, 0, 0)
    shoulders = disc(17, 50, 58.5).along_y().at(-1, 0, 111).with_mirror_y()
    handle = total([block((8, 8, 18), 3).at(-60, 0, 130).at(0, s * 22, 0) for s in (-1, 1)]) + block((8, 52, 8),
                   3).at(-60, 0, 139)
    foot_of_chest = box((3, 30, 5)).at(28.5, 0, 66)
    return total([waist, neck, shoulders, handle, foot_of_chest])

def number():
    back = plate(50, 50, 8).along_x().at(0, 0, 0)  # across along y, up along z, seen from +x
    behind = back.mapped(lambda p: (-p[0], -p[1], p[2])).at(-77.9, 0, 92)
    front = plate(30, 30, 5).along_x().at(39.4, 0, 96)
    return behind + front

def head_pan_frame():
    neck = disc(12, -2, 14)
    servo = block((34, 28, 22), 3).at(-6, 0, 24)
    horns = disc(9, 13, 19).along_y().at(10, 0, 28.5).with_mirror_y()
    return total([neck, servo, horns])

def _head(f):
    """`f` in a head whose middle is at y 0."""
    return f.at(0, -19, 0)

def head_shell():
    rings = []
    for k in range(11):  # an egg that is flat below
        z = 38 - 37.5 * math.cos(math.pi * (k + 1.1) / 12.2)
        bulge = (1 - abs((z - 38) / 38.5) ** 2.5) ** 0.5
        rings.append((z, 32 * bulge, 41.5 * bulge, 29 * bulge, -22, 0))
    return _head(loft(rings))

def head_team():
    ears = (disc(15, 38, 45.5, 2.5).along_y().at(-21, 0, 40)).with_mirror_y()
    stripe = total([box((15, 13, 5)).pitched(a).at(-22 + x, 0, z) for a, x, z in ((-0.3, -14, 71.2),
                   (0, 0, 73.6), (0.3, 14, 71.2))])
    return _head(ears + stripe)

def head_eye():
    """The visor, and the pupils."""
    visor = loft([(-12, 31, 15, 14, 0, 44.5), (10, 31, 15, 14, 0, 44.5),
                  (13.2, 28.5, 12.5, 12, 0, 44.5)], bevel=0, bevel_top=2, steps=4).along_x()
    pupils = disc(4.2, 0, 1.2).along_x().at(14.6, 15.5, 44).with_mirror_y()
    return _head(visor + pupils)

def head_light():
    eyes = disc(8.6, 0, 2.4).along_x().at(12.4, 15.5, 44).with_mirror_y()
    mouth = box((2, 16, 2.4)).at(12.4, 0, 21)
    return _head(eyes + mouth)

def head_frame():
    """The lens of the camera, whose front is camera_link, and the chin."""
    lens = ring(2.6, 5, 0, 2.4, 0.7).along_x().at(11.9, 0, 49.75)
    chin = box((5, 24, 8)).at(9, 0, 21)
    return _head(lens + chin)

def shoulder_frame():
    joint = disc(16, -1.5, 10).along_y()
    bridge = box((47, 6, 26)).at(0, 11, -6)
    arms = box((3.5, 34, 22)).at(21.6, 24, -10) + box((3.5, 34, 22)).at(-21.6, 24, -10)
    return total([joint, bridge, arms])

def upper_arm_frame():
    roll = disc(13, -19.4, 19.4).along_x().at(-19, 0, 0)
    elbow = disc(14.5, -17, 17).along_x().at(-19, 90.4, 0)
    bar = block((22, 80, 24), 3).at(-19, 46, 0)
    return total([roll, elbow, bar])

def upper_arm_shell():
    return loft(between([(14, 16, 16, 11, 0, -19), (28, 19.5, 19, 13, 0, -19), (48, 20.5, 20, 13, 0, -19),
                         (74, 16.5, 16.5, 11, 0, -19)], 2),
                bevel=3.5).along_y()

def forearm_frame():
    arms = box((3, 36, 20)).at(-19 + 19.2, 8, 0) + box((3, 36, 20)).at(-19 - 19.2, 8, 0)
    bridge = box((41, 5, 20)).at(-19, 24, 0)
    hand = loft([(92, 8, 10, 6, 0, -19), (104, 11, 14, 8, 0, -19), (118, 10, 13, 8, 0, -19), (126, 7, 9, 6, 0, -19)],
                bevel=3).along_y()
    thumb = loft([(98, 4, 4, 4, 12, -14), (113, 4.5, 4.5, 4.5, 15, -12)], bevel=3).along_y()
    return total([arms, bridge, hand, thumb])

def forearm_shell():
    return loft([(25, 14, 15, 9, 0, -19), (40, 17, 18, 11, 0, -19), (62, 16.5, 17.5, 11, 0, -19),
                         (88, 13, 14, 9, 0, -19)],
                bevel=3).along_y()

def forearm_team():
    return loft([(84, 13.6, 14.8, 9, 0, -19), (94, 13.0, 14.2, 9, 0, -19)], bevel=2).along_y()

def pelvis_team():
    return loft([(-41, 27, 52, 20, -12, 0), (-8, 27, 52, 20, -12, 0)], bevel_bottom=11, bevel_top=7, steps=4)


def pelvis_frame():
    bearing = disc(24, -10, -1).at(-6, 0, 0)
    hips = disc(17, -47, -34).at(0, 35, 0).with_mirror_y()
    return bearing + hips

def hip_yaw_frame():
    horn = disc(15, -9, 2)
    top = box((62, 28, 5)).at(-6, 0, -8)
    ends = box((4, 28, 36)).at(-35, 0, -23) + box((4, 28, 36)).at(23, 0, -23)
    return total([horn, top, ends])

def hip_roll_servo():
    body = block((48, 33, 31), 3.5).at(18, 0, 0)
    axles = disc(9, -10, 46).along_x()
    horns = disc(12, -19.5, 19.5).along_y().at(24.1, 0, 0)
    return total([body, axles, horns])

def thigh_frame():
    sides = (strap(0, 14, -79, 15, 19.3, 22.6)).with_mirror_y().at(0, -19, 0)
    knee = disc(15, -18.4, 18.4).along_y().at(0, -19, -110.15)
    bar = block((24, 30, 34), 3).at(0, -19, -92)
    return total([sides, knee, bar])

def thigh_shell():
    return loft([(-97, 16, 16, 10, 0, -19), (-82, 19, 18.5, 11, 0, -19), (-54, 21.5, 18.5, 12, 1, -19),
                         (-38, 19.5, 18.3, 12, 1, -19),
                         (-27, 15, 16, 10, 0, -19)], bevel=3.5)

def shin_frame():
    knee = (strap(0, 13.5, -34, 12, 18.8, 22)).with_mirror_y().at(0, -19, 0)
    ankle = (strap(-74, 12, -110, 13, 17.6, 20.8)).with_mirror_y().at(0, -19, 0)
    bar = block((20, 32, 62), 3).at(-2, -19, -54)
    return total([knee, ankle, bar])

def shin_shell():
    return loft([(-88, 12, 15, 9, -3, -19), (-70, 15.5, 16.6, 10, -4, -19), (-46, 18, 17.2, 11, -4, -19),
                 (-27, 16, 16.6, 10, -3, -19),
                 (-18, 11, 13, 8, -2, -19)], bevel=3.5)

def shin_team():
    """The guard in front."""
    return loft([(-84, 7, 10, 6, 9, -19), (-66, 8, 13.5, 7, 10, -19), (-38, 9, 14.5, 8, 11, -19),
                         (-21, 7, 10, 6, 10, -19)], bevel=2.5)

def ankle_servo():
    body = block((48, 33, 31), 3.5).at(-6, -19, 0)
    axles = disc(9, -34, 22).along_x().at(0, -19, 0)
    horns = disc(12, -17.2, 17.2).along_y().at(0, -19, 0)
    return total([body, axles, horns])

def foot_frame():
    back = box((4, 26, 40)).at(-10, 0, -8)
    front = box((4, 26, 40)).at(48, 0, -8)
    return back + front

def foot_shell():
    base = loft([(-28.5, 51.5, 32, 15, 26.5, 10), (-22, 51.5, 32, 15, 26.5, 10), (-19, 48, 29, 14, 26.0, 9)], bevel=1.2,
                bevel_top=2.2)
    return base

def foot_team():
    toe = loft([(-24, 16, 27, 12, 60, 10), (-19, 15.5, 26, 12, 59.5, 10),
                (-12, 10, 19, 10, 57, 9)], bevel=0, bevel_top=3)
    heel = loft([(-24, 10, 25, 9, -13, 9), (-19, 9.5, 24, 9, -13, 9),
                 (-10, 6, 17, 6, -12, 6)], bevel=0, bevel_top=2.5)
    return toe + heel

def foot_sole():
    """The plate with a pad, the end of a load cell, in each corner."""
    sole = loft([(-29.3, 50.5, 31, 14, 26.5, 10), (-26, 51.9, 32.4, 15, 26.5, 10)], bevel=0)
    pads = total([disc(7, -30.5, -28, 0, 12).at(26.5 + sx * 42, 10 + sy * 22.5, 0) for sx in (-1, 1) for sy in (-1,
                 1)])
    return sole + pads

def parts():
    functions = [trunk_shell, trunk_team, trunk_frame, number, head_pan_frame, head_shell, head_team, head_eye,
        head_light,
                 head_frame, shoulder_frame, upper_arm_frame, upper_arm_shell, forearm_frame, forearm_shell,
                     forearm_team,
                 pelvis_team, pelvis_frame, hip_yaw_frame, hip_roll_servo, thigh_frame, thigh_shell, shin_frame,
                     shin_shell,
                 shin_team, ankle_servo, foot_frame, foot_shell, foot_team, foot_sole]
    return {f.__name__: f().scaled(0.001) for f in functions}
