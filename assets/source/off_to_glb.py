#!/usr/bin/env python3
"""Makes one .glb of several OFF meshes, a material each.

off_to_glb.py OUT.glb NAME MESH.off=MATERIAL:R,G,B,METALLIC,ROUGHNESS ...

The meshes are in millimetres with z up and their front towards -y; glTF is in metres with y up and its front towards
+z. Colours are linear. Edges sharper than CREASE stay hard.
"""

import json
import math
import struct
import sys

CREASE = math.cos(math.radians(32))


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    # The header is "OFF" and three counts; the third, of edges, is not used.
    if words[0] != "OFF":
        sys.exit(f"{path}: not an OFF mesh")
    vertex_count, face_count = int(words[1]), int(words[2])
    numbers = words[4:]
    vertices = [tuple(float(n) for n in numbers[3 * i : 3 * i + 3]) for i in range(vertex_count)]
    triangles, at = [], 3 * vertex_count
    for _ in range(face_count):
        corners = [int(n) for n in numbers[at + 1 : at + 1 + int(numbers[at])]]
        at += 1 + len(corners)
        triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    # OpenSCAD's order differs from run to run; sorted corners and triangles make the result the same every time.
    order = sorted(range(vertex_count), key=lambda i: vertices[i])
    rank = {old: new for new, old in enumerate(order)}
    triangles = sorted(smallest_first([rank[i] for i in t]) for t in triangles if len(set(t)) == 3)
    return [(x / 1000, z / 1000, -y / 1000) for x, y, z in (vertices[i] for i in order)], triangles


def smallest_first(triangle):
    at = triangle.index(min(triangle))
    return triangle[at:] + triangle[:at]


def subtract(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    length = math.sqrt(dot(a, a))
    return tuple(p / length for p in a) if length > 0 else None


def with_normals(vertices, triangles):
    """Splits vertices along creases. Normals are weighted by area, so that large flat faces stay flat beside fillets."""
    areas = [cross(subtract(vertices[b], vertices[a]), subtract(vertices[c], vertices[a])) for a, b, c in triangles]
    units = [normalized(area) for area in areas]
    around = {}
    for index, triangle in enumerate(triangles):
        for corner in triangle:
            around.setdefault(vertices[corner], []).append(index)
    known, points, normals, indices = {}, [], [], []
    for index, triangle in enumerate(triangles):
        if units[index] is None:
            continue
        for corner in triangle:
            near = [i for i in around[vertices[corner]] if units[i] and dot(units[i], units[index]) >= CREASE]
            normal = normalized(tuple(sum(areas[i][axis] for i in near) for axis in range(3)))
            key = (vertices[corner], tuple(round(n, 5) for n in normal))
            if key not in known:
                known[key] = len(points)
                points.append(vertices[corner])
                normals.append(normal)
            indices.append(known[key])
    return points, normals, indices


class Glb:
    def __init__(self, name):
        self.data = b""
        self.json = {
            "asset": {"version": "2.0", "generator": "onestroke assets/build_models"},
            "scene": 0,
            "scenes": [{"name": name, "nodes": [0]}],
            "nodes": [{"name": name, "mesh": 0}],
            "meshes": [{"name": name, "primitives": []}],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def add_accessor(self, data, target, accessor):
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), "target": target}
        )
        self.data += data + bytes(-len(data) % 4)
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, **accessor})
        return len(self.json["accessors"]) - 1

    def add_vectors(self, vectors, bounds):
        data = b"".join(struct.pack("<3f", *v) for v in vectors)
        accessor = {"componentType": 5126, "count": len(vectors), "type": "VEC3"}
        if bounds:
            # As stored: a viewer compares the bounds with the numbers in the buffer.
            stored = [struct.unpack_from("<3f", data, 12 * i) for i in range(len(vectors))]
            accessor["min"] = [min(v[axis] for v in stored) for axis in range(3)]
            accessor["max"] = [max(v[axis] for v in stored) for axis in range(3)]
        return self.add_accessor(data, 34962, accessor)

    def add_mesh(self, path, material, numbers):
        points, normals, indices = with_normals(*read_off(path))
        wide = len(points) > 65535
        index_data = struct.pack(f"<{len(indices)}{'I' if wide else 'H'}", *indices)
        index_type = 5125 if wide else 5123
        self.json["meshes"][0]["primitives"].append(
            {
                "attributes": {"POSITION": self.add_vectors(points, True), "NORMAL": self.add_vectors(normals, False)},
                "indices": self.add_accessor(
                    index_data, 34963, {"componentType": index_type, "count": len(indices), "type": "SCALAR"}
                ),
                "material": len(self.json["materials"]),
            }
        )
        red, green, blue, metallic, roughness = numbers
        self.json["materials"].append(
            {
                "name": material,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [red, green, blue, 1],
                    "metallicFactor": metallic,
                    "roughnessFactor": roughness,
                },
            }
        )
        return len(indices) // 3

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(self.data)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.data), b"BIN\0") + self.data)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    out, name, *parts = sys.argv[1:]
    glb = Glb(name)
    triangles = 0
    for part in parts:
        path, look = part.split("=")
        material, numbers = look.split(":")
        triangles += glb.add_mesh(path, material, [float(n) for n in numbers.split(",")])
    glb.write(out)
    print(f"{out}: {triangles} triangles")


main()
