# SPDX-License-Identifier: MIT
"""Binary glTF 2.0 (Khronos Group): a mesh of one material, y up."""
import array
import json
import struct
import sys


def _bytes(kind, values):
    a = array.array(kind, values)
    if sys.byteorder == "big":
        a.byteswap()
    data = a.tobytes()
    return data + b"\0" * (-len(data) % 4)


def written(surface, name):
    # Micrometres: what sines of different C libraries say differs by less.
    points = [tuple(round(c, 6) + 0.0 for c in (p[0], p[2], -p[1])) for p in surface.points]
    if len(points) > 65535:
        raise ValueError(f"{name} has {len(points)} points; indices of 16 bits reach 65535")
    positions = _bytes("f", [c for p in points for c in p])
    indices = _bytes("H", [i for t in surface.triangles for i in t])
    views, accessors, chunks = [], [], []

    def add(data, count, kind, component, target, **more):
        views.append({"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": len(data), "target": target})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind,
                         **more})
        chunks.append(data)
        return len(accessors) - 1

    attributes = {"POSITION": add(positions, len(points), "VEC3", 5126, 34962,
                                  min=[min(p[k] for p in points) for k in range(3)],
                                  max=[max(p[k] for p in points) for k in range(3)])}
    if surface.coordinates is not None:
        picture = _bytes("f", [round(c, 6) for at in surface.coordinates for c in at])
        attributes["TEXCOORD_0"] = add(picture, len(points), "VEC2", 5126, 34962)
    triangles = add(indices, 3 * len(surface.triangles), "SCALAR", 5123, 34963)
    body = b"".join(chunks)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": triangles}]}],
        "buffers": [{"byteLength": len(body)}], "bufferViews": views, "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(body)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(body), b"BIN\0") + body)
