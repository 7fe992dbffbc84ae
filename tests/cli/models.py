"""Makes small models in several formats from lists, so that no file of a modeller needs to be kept.

A model is right-handed with y up, unless its format says otherwise. Faces are counterclockwise seen from outside.
"""
import base64
import json
import struct
import zlib

#: The unit cube around the origin has for each face its normal and its corners, with texture coordinates whose v runs up.
FACES = {
    "+x": ((1, 0, 0), ((1, -1, 1), (1, -1, -1), (1, 1, -1), (1, 1, 1))),
    "-x": ((-1, 0, 0), ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1))),
    "+y": ((0, 1, 0), ((-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1))),
    "-y": ((0, -1, 0), ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1))),
    "+z": ((0, 0, 1), ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))),
    "-z": ((0, 0, -1), ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1))),
}
UV = ((0, 0), (1, 0), (1, 1), (0, 1))
#: The colours of the faces are red towards +x, green towards +y, blue towards +z, and their complements.
COLORS = {"+x": (1, 0, 0), "-x": (0, 1, 1), "+y": (0, 1, 0), "-y": (1, 0, 1), "+z": (0, 0, 1), "-z": (1, 1, 0)}


def cube():
    """Returns positions, normals, texture coordinates and colours of 24 vertices, and the six quads."""
    positions, normals, uvs, colors = [], [], [], []
    for name, (normal, corners) in FACES.items():
        for corner, uv in zip(corners, UV):
            positions.append(tuple(c / 2 for c in corner))
            normals.append(normal), uvs.append(uv), colors.append(COLORS[name])
    return positions, normals, uvs, colors, [tuple(range(4 * k, 4 * k + 4)) for k in range(6)]


def triangles(quads):
    return [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def png(size, texel):
    """Returns a square picture. `texel` gives the bytes of column x in row y from the top: one of grey or three of colour, and one more
    with alpha."""
    rows = [[bytes(texel(x, y)) for x in range(size)] for y in range(size)]
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", size, size, 8, {1: 0, 2: 4, 3: 2, 4: 6}[len(rows[0][0])], 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + b"".join(row) for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def obj(positions, faces, uvs=(), normals=(), colors=(), before="", material=""):
    """Writes OBJ. Texture coordinates, normals and colours have the indices of the positions."""
    suffix = lambda i: f"/{i if uvs else ''}/{i}" if normals else f"/{i}" if uvs else ""
    rows = [p + (tuple(colors[i]) if colors else ()) for i, p in enumerate(positions)]
    lines = [before] + ["v " + " ".join(map(str, row)) for row in rows] + [f"vt {u} {v}" for u, v in uvs]
    lines += [f"vn {x} {y} {z}" for x, y, z in normals] + ([f"usemtl {material}"] if material else [])
    lines += ["f " + " ".join(f"{i + 1}{suffix(i + 1)}" for i in face) for face in faces]
    return "\n".join(lines) + "\n"


def ply(positions, faces, colors=(), binary=False):
    names = "property uchar red\nproperty uchar green\nproperty uchar blue\n" if colors else ""
    head = (f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\nelement vertex {len(positions)}\n"
            f"property float x\nproperty float y\nproperty float z\n{names}"
            f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = [(*p, *(int(255 * c) for c in (colors[i] if colors else ()))) for i, p in enumerate(positions)]
    if not binary:
        return head + "".join(" ".join(map(str, r)) + "\n" for r in rows) + "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in faces)
    body = b"".join(struct.pack("<3f" + ("3B" if colors else ""), *r) for r in rows)
    return head.encode() + body + b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces)


def stl(positions, faces):
    """Writes binary STL without normals."""
    out = b"made by a test".ljust(80) + struct.pack("<I", len(faces))
    for face in faces:
        out += struct.pack("<12fH", 0, 0, 0, *(c for i in face for c in positions[i]), 0)
    return out


class Gltf:
    """A scene of glTF 2.0. Its calls add to it and return indices."""

    def __init__(self):
        self.data = b""
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "accessors": [], "bufferViews": []}

    def add(self, kind, entry):
        self.document.setdefault(kind, []).append(entry)
        return len(self.document[kind]) - 1

    def view(self, data, stride=0):
        self.data += b"\0" * (-len(self.data) % 4)
        start = len(self.data)
        self.data += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": start, "byteLength": len(data), **({"byteStride": stride} if stride else {})})

    def floats(self, rows):
        width = len(rows[0])
        flat = [c for row in rows for c in row]
        accessor = {"bufferView": self.view(struct.pack(f"<{len(flat)}f", *flat)), "componentType": 5126, "count": len(rows),
                    "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width]}
        finite = [[x for x in column if x == x and abs(x) < 1e38] or [0] for column in zip(*rows)]
        return self.add("accessors", {**accessor, "min": [min(c) for c in finite], "max": [max(c) for c in finite]})

    def integers(self, rows, kind, stride=0, **more):
        """Adds integers. `kind` is a format character of the module struct; elements begin `stride` bytes after one another, if
        it is given."""
        packed = [struct.pack(f"<{len(row)}{kind}", *row) for row in rows]
        accessor = {"componentType": {"b": 5120, "B": 5121, "h": 5122, "H": 5123}[kind], "count": len(rows), "type": f"VEC{len(rows[0])}", **more}
        return self.add("accessors", {**accessor, "bufferView": self.view(b"".join(p.ljust(stride, b"\0") for p in packed), stride)})

    def indices(self, values):
        return self.add("accessors", {"bufferView": self.view(struct.pack(f"<{len(values)}I", *values)), "componentType": 5125, "count": len(values), "type": "SCALAR"})

    def mesh(self, positions, faces, material=None, mode=4, name="mesh", **attributes):
        """Adds a mesh. `attributes` are NORMAL, TEXCOORD_0 and COLOR_0; the v of the given texture coordinates runs up, so it is turned for glTF."""
        for key, rows in attributes.items():
            if key.startswith("TEXCOORD"):
                attributes[key] = [(u, 1 - v) for u, v in rows]
        primitive = {"attributes": {k: self.floats(v) for k, v in {"POSITION": positions, **attributes}.items()}, "mode": mode}
        if faces:
            primitive["indices"] = self.indices([i for f in faces for i in f])
        if material is not None:
            primitive["material"] = material
        return self.add("meshes", {"name": name, "primitives": [primitive]})

    def node(self, root=True, **entry):
        index = self.add("nodes", entry)
        if root:
            self.document["scenes"][0]["nodes"].append(index)
        return index

    def image(self, png, name="image"):
        """Adds a texture whose picture is kept within the file."""
        return self.add("textures", {"source": self.add("images", {"bufferView": self.view(png), "mimeType": "image/png", "name": name})})

    def light(self, **entry):
        self.document.setdefault("extensionsUsed", ["KHR_lights_punctual"])
        lights = self.document.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {}).setdefault("lights", [])
        lights.append(entry)
        return {"KHR_lights_punctual": {"light": len(lights) - 1}}

    def _document(self, uri=None):
        return json.dumps({**self.document, "buffers": [{"byteLength": len(self.data), **({"uri": uri} if uri else {})}]})

    def gltf(self):
        return self._document("data:application/octet-stream;base64," + base64.b64encode(self.data).decode())

    def apart(self, uri):
        """Returns the document alone. The numbers are expected in another file."""
        return self._document(uri)

    def glb(self):
        text, data = self._document().encode(), self.data
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def fbx(positions, faces, normals, area=None):
    """Writes FBX as text of version 7.4, with an area light at `area` that shines along -y."""
    points = ",".join(f"{c}" for p in positions for c in p)
    indices = ",".join(str(i if k + 1 < len(f) else -i - 1) for f in faces for k, i in enumerate(f))
    corners = ",".join(f"{c}" for f in faces for i in f for c in normals[i])
    lamp = f""" NodeAttribute: 5, "NodeAttribute::lamp", "Light" {{ TypeFlags: "Light"
  GeometryVersion: 124
  Properties70:  {{ P: "LightType", "enum", "", "",3
   P: "Color", "Color", "", "A",1,1,1
   P: "Intensity", "Number", "", "A",100 }} }}
 Model: 4, "Model::lamp", "Light" {{ Version: 232
  Properties70:  {{ P: "Lcl Translation", "Lcl Translation", "", "A",{area[0]},{area[1]},{area[2]} }} }}
""" if area else ""
    return f"""; FBX 7.4.0 project file
FBXHeaderExtension:  {{ FBXHeaderVersion: 1003
 FBXVersion: 7400 }}
GlobalSettings:  {{ Version: 1000
 Properties70:  {{ P: "UpAxis", "int", "Integer", "",1
  P: "UpAxisSign", "int", "Integer", "",1 }} }}
Definitions:  {{ Version: 100 }}
Objects:  {{
 Geometry: 1, "Geometry::cube", "Mesh" {{
  Vertices: *{3 * len(positions)} {{ a: {points} }}
  PolygonVertexIndex: *{sum(map(len, faces))} {{ a: {indices} }}
  GeometryVersion: 124
  LayerElementNormal: 0 {{ Version: 101
   Name: ""
   MappingInformationType: "ByPolygonVertex"
   ReferenceInformationType: "Direct"
   Normals: *{3 * sum(map(len, faces))} {{ a: {corners} }} }}
  LayerElementMaterial: 0 {{ Version: 101
   Name: ""
   MappingInformationType: "AllSame"
   ReferenceInformationType: "IndexToDirect"
   Materials: *1 {{ a: 0 }} }}
  Layer: 0 {{ Version: 100
   LayerElement:  {{ Type: "LayerElementMaterial"
    TypedIndex: 0 }}
   LayerElement:  {{ Type: "LayerElementNormal"
    TypedIndex: 0 }} }}
 }}
 Model: 2, "Model::cube", "Mesh" {{ Version: 232
  Properties70:  {{ P: "Lcl Translation", "Lcl Translation", "", "A",0,0,0 }}
 }}
 Material: 3, "Material::red paint", "" {{ Version: 102
  ShadingModel: "phong"
  Properties70:  {{ P: "DiffuseColor", "Color", "", "A",0.8,0.1,0.1 }} }}
{lamp}}}
Connections:  {{
 {'C: "OO",5,4' if area else ""}
 {'C: "OO",4,0' if area else ""}
 C: "OO",2,0
 C: "OO",1,2
 C: "OO",3,2
}}
"""


def collada(positions, faces, light="", camera=""):
    """Writes COLLADA 1.4. `light` and `camera` are elements of technique_common, and both look along -z from (0, 0, 4)."""
    points = " ".join(f"{c}" for p in positions for c in p)
    counts, corners = " ".join(str(len(f)) for f in faces), " ".join(str(i) for f in faces for i in f)
    library = lambda kind, content: f'<library_{kind}s><{kind} id="{kind}" name="{kind}">{content}</{kind}></library_{kind}s>' if content else ""
    common = lambda content: f"<technique_common>{content}</technique_common>"
    placed = lambda kind, content: f'<node id="of_{kind}"><translate>0 0 4</translate><instance_{kind} url="#{kind}"/></node>' if content else ""
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
{library("light", light and common(light))}{library("camera", camera and f"<optics>{common(camera)}</optics>")}
<library_geometries><geometry id="shape"><mesh>
 <source id="places"><float_array id="numbers" count="{3 * len(positions)}">{points}</float_array>
  <technique_common><accessor source="#numbers" count="{len(positions)}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
 <polylist count="{len(faces)}"><input semantic="VERTEX" source="#corners" offset="0"/><vcount>{counts}</vcount><p>{corners}</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="all"><node id="thing"><instance_geometry url="#shape"/></node>{placed("light", light)}{placed("camera", camera)}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#all"/></scene>
</COLLADA>
"""
