"""Checks that includes point down, never sideways, and never into another unit's private folder (docs/architecture.md)."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
rank, public, unit_named = {}, {}, {}  # `rank` has a unit's line, `public` the folders that may include its private headers, `unit_named` the unit of a prefix.
for line_number, line in enumerate((root / "tests/layers.txt").read_text().splitlines()):
    for names in line.split("#")[0].split():
        folder, *headers = names.split(":")
        unit = folder.rstrip("*~")
        rank[unit] = line_number
        public[unit] = "" if folder.endswith("*") else unit.split("/")[0] + "/" if folder.endswith("~") else unit
        unit_named.update({name: unit for name in (unit, *headers)})


def unit_of(path):
    """Returns the unit with the longest prefix that is listed: reyes/shade/batch.h and reyes/shade.h belong to reyes/shade."""
    parts = path.rsplit(".", 1)[0].split("/")
    prefixes = ("/".join(parts[:k]) for k in range(len(parts), 0, -1))
    return next((unit_named[p] for p in prefixes if p in unit_named), None)


def is_private(path, unit):
    """Returns whether a path is in the folder of the unit."""
    return path.startswith(unit + "/")


SHADER_HEADERS = {"reyes/shader_api", "reyes/shader", "reyes/shader/noise", "reyes/shader/ggx", "reyes/shader/shadeops", "reyes/sl",
                  "reyes/shader/sl_patterns"}
# Each third-party library is included by the units named here and nowhere else.
THIRD_PARTY = {
    "embree3/": ["raytrace/embree_"],
    "opensubdiv/": ["reyes/prim/subdivision_"],
    "OpenImageIO/": ["reyes/pictures/"],
    "openvdb/": ["reyes/vdb/module.cpp"],
    "assimp/": ["reyes/bindings/assimp/"],
    "OpenEXR/": ["reyes/image/exr_", "reyes/pictures/exr_reader.cpp"],
    "Imath": ["reyes/image/exr_", "reyes/pictures/exr_reader.cpp"],
    "tiff": ["reyes/image/tiff_module.cpp"],
    "png.h": ["reyes/image/png_file.cpp"],
    "libdeflate.h": ["reyes/image/exr_rows.cpp"],
    "tbb/": ["reyes/base/parallel.cpp"],
    "nlohmann/": ["reyes/app/", "reyes/bindings/assimp/gltf_buffers.h"],
    "CLI/": ["reyes/app/"],
    "httplib.h": ["reyes/app/relight/http_module.cpp"],
    "zstd.h": ["reyes/base/chunk_file.cpp", "reyes/base/record_file.cpp"],
    "xxhash.h": ["reyes/base/checksum.cpp"],
    "hwy/": ["reyes/base/vector.h", "reyes/base/vector_targets.cpp"],
    "zlib.h": ["reyes/rib/stream.cpp"],
    "zip.h": ["reyes/rib/zip_module.cpp"],
}

bad = []
for folder in ("reyes", "raytrace", "gi", "shaders", "displays"):
    for file in sorted((root / folder).rglob("*.[hc]*")):
        me = file.relative_to(root).as_posix()
        if me.startswith("shaders/include/"):
            continue  # These are functions of the shading language, not of C++.
        for line_number, line in enumerate(file.read_text().splitlines(), 1):
            if m := re.match(r"\s*#\s*include\s+<([^>]+)>", line):
                for library, users in THIRD_PARTY.items():
                    if m[1].startswith(library) and not any(me.startswith(u) for u in users):
                        bad.append(f"{me}:{line_number}: <{m[1]}> belongs to {', '.join(users)}")
            if not (m := re.match(r'\s*#\s*include\s+"([^"]+)"', line)):
                continue
            a, b = unit_of(me), unit_of(m[1])
            if a is None or b is None:
                bad.append(f"{me}:{line_number}: {m[1]} or this file is not in tests/layers.txt")
            elif a != b and (
                rank[b] >= rank[a]
                or (is_private(m[1], b) and not me.startswith(public[b]))
                or (a == "shaders" and b not in SHADER_HEADERS)
                or (a == "displays" and m[1] != "reyes/display_api.h")
            ):
                bad.append(f"{me}:{line_number}: {a} may not include {m[1]}")
print("\n".join(bad))
sys.exit(bool(bad))
