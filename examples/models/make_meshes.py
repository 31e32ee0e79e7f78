#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of the robots in this folder, and the pictures of their numbers:

    python3 examples/models/make_meshes.py            # to examples/models/meshes
    python3 examples/models/make_meshes.py FOLDER

Needs nothing but Python. Every run writes the same bytes. What the robots look like is in mesh_shapes/.
"""
import pathlib
import sys

sys.dont_write_bytecode = True
from mesh_shapes import glb, humanoid, numbers, quadruped, rover, soccer_omni  # noqa: E402


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "meshes"
    for robot in (humanoid, quadruped, soccer_omni, rover):
        name = robot.__name__.split(".")[-1]
        for part, surface in robot.parts().items():
            path = folder / name / (part + ".glb")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(glb.written(surface, part))
    (folder / "numbers").mkdir(parents=True, exist_ok=True)
    for number in range(1, 12):
        (folder / "numbers" / f"{number}.png").write_bytes(numbers.png(number))


if __name__ == "__main__":
    main()
