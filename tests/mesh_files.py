"""Small mesh files of every kind for tests, each holding the same surface."""

from __future__ import annotations

import struct
from collections.abc import Callable

from tests.gltf_files import SceneFile
from tests.soups import Soup

ROOM = """\
v 0 0 0
v 4 0 0
v 4 4 0
v 0 4 0
v 0 0 3
v 4 0 3
v 2 2 1
f 1 2 7
f 2 3 7
f 3 4 7
f 4 1 7
f 1 5 2
f 2 5 6
"""
"""An OBJ file of a floor with a peak in it and a wall: no convex hull, but hulls can be made of it."""


def obj(soup: Soup) -> bytes:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in soup[0].tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (soup[1] + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


def stl_binary(soup: Soup, title: bytes = b"title") -> bytes:
    rows = [struct.pack("<12fH", 0, 0, 0, *t.ravel(), 7) for t in soup[0][soup[1]]]
    return title.ljust(80) + struct.pack("<I", len(rows)) + b"".join(rows)


def stl_ascii(soup: Soup, name: str = "part") -> bytes:
    rows = [
        "  facet normal 0 0 0\n    outer loop\n"
        + "".join(f"      vertex {x!r} {y!r} {z!r}\n" for x, y, z in triangle)
        + "    endloop\n  endfacet\n"
        for triangle in soup[0][soup[1]].tolist()
    ]
    return f"solid {name}\n{''.join(rows)}endsolid {name}\n".encode()


def ply(soup: Soup, order: str = "ascii", *, extra: bool = False) -> bytes:
    """A PLY; extra: with colours behind the coordinates and a quality for each face."""
    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n" if extra else ""
    quality = "property float quality\n" if extra else ""
    head = (
        f"ply\nformat {order} 1.0\ncomment made for a test\nelement vertex {len(soup[0])}\n"
        f"property float x\nproperty float y\nproperty float z\n{colors}"
        f"element face {len(soup[1])}\nproperty list uchar int vertex_indices\n{quality}end_header\n"
    ).encode()
    if order == "ascii":
        rows = [f"{x:g} {y:g} {z:g}" + " 10 20 30" * extra for x, y, z in soup[0].tolist()]
        rows += [f"3 {a} {b} {c}" + " 0.125" * extra for a, b, c in soup[1].tolist()]
        return head + ("\n".join(rows) + "\n").encode()
    mark = "<" if "little" in order else ">"
    body = b"".join(struct.pack(f"{mark}3f", *v) + b"\x0a\x14\x1e" * extra for v in soup[0])
    tail = struct.pack(f"{mark}f", 0.125) * extra
    return head + body + b"".join(struct.pack(f"{mark}B3i", 3, *f) + tail for f in soup[1].tolist())


def wrl(soup: Soup) -> bytes:
    points = ", ".join(f"{x!r} {y!r} {z!r}" for x, y, z in soup[0].tolist())
    corners = ", ".join(f"{a}, {b}, {c}, -1" for a, b, c in soup[1].tolist())
    return (
        "#VRML V2.0 utf8\n# a comment\nGroup {\n children [ Shape { appearance Appearance { material Material {} }\n"
        f" geometry IndexedFaceSet {{ solid TRUE coord DEF co Coordinate {{ point [ {points} ] }}\n"
        f" coordIndex [ {corners} ] }} }} ]\n}}\n"
    ).encode()


def dae(soup: Soup, *, unit: float = 1.0, node: str = "") -> bytes:
    """A Collada file; node: elements of its node ahead of the geometry, such as a transform."""
    points = " ".join(map(repr, soup[0].ravel().tolist()))
    corners = " ".join(map(str, soup[1].ravel().tolist()))
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="some" meter="{unit}"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="shape"><mesh>
<source id="p"><float_array id="pa" count="{soup[0].size}">{points}</float_array><technique_common>
<accessor source="#pa" count="{len(soup[0])}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(soup[1])}"><input semantic="VERTEX" source="#v" offset="0"/><p>{corners}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="part">{node}<instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


def gltf(soup: Soup, **node: object) -> bytes:
    return _scene(soup, node).gltf()


def glb(soup: Soup, **node: object) -> bytes:
    return _scene(soup, node).glb()


def _scene(soup: Soup, node: dict[str, object]) -> SceneFile:
    scene = SceneFile()
    scene.node("part", soup, **node)
    return scene


KINDS: dict[str, tuple[str, Callable[[Soup], bytes]]] = {
    "obj": (".obj", obj),
    "binary stl": (".stl", stl_binary),
    "ascii stl": (".STL", stl_ascii),
    "ascii ply": (".ply", ply),
    "little-endian ply": (".ply", lambda s: ply(s, "binary_little_endian")),
    "big-endian ply": (".ply", lambda s: ply(s, "binary_big_endian", extra=True)),
    "vrml": (".wrl", wrl),
    "collada": (".dae", dae),
    "gltf": (".gltf", gltf),
    "glb": (".glb", glb),
}
"""Of each kind, the suffix and what writes it."""
