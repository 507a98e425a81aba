"""Makes the binary inputs of `tests/corpus`: STL, PLY, archives, USD. Usage: python -m tests.corpus_binaries"""

from __future__ import annotations

import gzip
import io
import struct
import zipfile
from collections.abc import Mapping

import numpy as np

from tests import usd_crates as crates
from tests.corpus_case import ROOT
from tests.soups import Soup, box

CUBE = box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
COLOURED = 0x8000


def stl(soup: Soup = CUBE, *, title: bytes = b"made for a test", count: int | None = None, attribute: int = 0) -> bytes:
    """A binary STL; count: what its header says, if that is not true."""
    triangles = soup[0][soup[1]]
    rows = [struct.pack("<12fH", 0, 0, 0, *t.ravel(), attribute) for t in triangles]
    return title.ljust(80) + struct.pack("<I", len(rows) if count is None else count) + b"".join(rows)


def changed(soup: Soup, value: float) -> Soup:
    """The surface with one coordinate replaced."""
    points = soup[0].copy()
    points[-1, 0] = value
    return points, soup[1]


def ply(order: str, *, vertices: int | None = None, faces: int | None = None, length: str = "uchar") -> bytes:
    """A binary PLY; vertices, faces: what its header says, if that is not true; length: the type of list lengths."""
    mark = "<" if "little" in order else ">"
    letter = {"uchar": "B", "char": "b", "float": "f", "uint": "I", "double": "d"}[length]
    head = (
        f"ply\nformat binary_{order} 1.0\nelement vertex {8 if vertices is None else vertices}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {12 if faces is None else faces}\nproperty list {length} int vertex_indices\nend_header\n"
    ).encode()
    body = b"".join(struct.pack(f"{mark}3f", *v) for v in CUBE[0])
    return head + body + b"".join(struct.pack(f"{mark}{letter}3i", 3, *f) for f in CUBE[1])


def with_bytes(data: bytes, at: int, new: bytes) -> bytes:
    return data[:at] + new + data[at + len(new) :]


def zipped(name: str, content: bytes) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr(zipfile.ZipInfo(name), content)
    return made.getvalue()


def stl_files() -> Mapping[str, bytes]:
    whole = stl()
    shifted = CUBE[0] + [3.0, 0.0, 0.0], CUBE[1]
    both = np.concatenate([CUBE[0], shifted[0]]), np.concatenate([CUBE[1], shifted[1] + len(CUBE[0])])
    return {
        "binary_cube.stl": whole,
        "binary_begins_with_solid.stl": stl(title=b"solid made by a tool that knows no better"),
        "binary_begins_with_solid_and_has_bytes_behind.stl": stl(title=b"solid made by a tool") + b"more",
        "binary_begins_with_solid_and_is_cut.stl": stl(title=b"solid made by a tool")[:-100],
        "binary_title_says_facet_normal.stl": stl(title=b"solid facet normal vertex 1 2 3 endfacet"),
        "binary_cut_in_the_title.stl": whole[:40],
        "binary_cut_behind_the_title.stl": whole[:80],
        "binary_cut_behind_the_count.stl": whole[:84],
        "binary_cut_in_a_triangle.stl": whole[:-20],
        "binary_cut_behind_a_triangle.stl": whole[:-50],
        "binary_count_too_small.stl": stl(count=6),
        "binary_count_zero.stl": stl(count=0),
        "binary_of_no_triangle.stl": whole[:80] + bytes(4),
        "bomb_binary_count_of_ten_million.stl": stl(count=10_000_000),
        "bomb_binary_count_of_all_ones.stl": stl(count=0xFFFFFFFF),
        "binary_bytes_behind.stl": whole + b"a tool wrote its own data behind the last triangle",
        "binary_not_a_number.stl": stl(changed(CUBE, float("nan"))),
        "binary_signalling_not_a_number.stl": with_bytes(whole, 96, b"\1\0\x80\x7f"),
        "binary_infinite.stl": stl(changed(CUBE, float("inf"))),
        "binary_3e38.stl": stl(changed(CUBE, 3e38)),
        "binary_denormal.stl": stl((CUBE[0] * 1e-44, CUBE[1])),
        "binary_normals_wrong.stl": whole[:84]
        + whole[84:].replace(bytes(12) + whole[96:100], struct.pack("<3f", 7, 7, 7) + whole[96:100]),
        "binary_with_colours.stl": stl(title=b"COLOR=\x7f\x7f\x7f\xff", attribute=COLOURED),
        "binary_all_zeros.stl": bytes(len(whole)),
        "binary_zeros_behind_the_count.stl": whole[:84] + bytes(len(whole) - 84),
        "binary_millimetres.stl": stl((CUBE[0] * 1000, CUBE[1])),
        "binary_two_cubes.stl": stl(both),
        "binary_same_cube_twice.stl": stl((CUBE[0], np.concatenate([CUBE[1], CUBE[1]]))),
        "binary_single_triangle.stl": stl((CUBE[0], CUBE[1][:1])),
        "BINARY_CUBE.STL": whole,
        "compressed_by_gzip.stl": gzip.compress(whole, mtime=0),
        "archive.stl": zipped("cube.stl", whole),
        "picture.stl": b"\x89PNG\r\n\x1a\n" + bytes(200),
        "text_in_utf16.stl": "solid cube\nendsolid cube\n".encode("utf-16"),
    }


def ply_files() -> Mapping[str, bytes]:
    little, big = ply("little_endian"), ply("big_endian")
    body = little.index(b"end_header\n") + 11
    return {
        "little_endian_cube.ply": little,
        "big_endian_cube.ply": big,
        "little_endian_cut_in_vertices.ply": little[: body + 50],
        "little_endian_cut_in_faces.ply": little[:-7],
        "little_endian_cut_behind_a_face.ply": little[:-13],
        "big_endian_cut_in_faces.ply": big[:-7],
        "little_endian_bytes_behind.ply": little + b"more of it",
        "little_endian_that_is_big.ply": big.replace(b"big_endian", b"little_endian"),
        "bomb_little_endian_ten_million_vertices.ply": ply("little_endian", vertices=10_000_000),
        "bomb_little_endian_ten_million_faces.ply": ply("little_endian", faces=10_000_000),
        "bomb_little_endian_list_of_two_thousand_million.ply": with_bytes(
            ply("little_endian", length="uint"), len(ply("little_endian", length="uint")) - 16, b"\xff\xff\xff\x7f"
        ),
        "little_endian_index_beyond_the_end.ply": with_bytes(little, len(little) - 4, struct.pack("<i", 8)),
        "little_endian_index_negative.ply": with_bytes(little, len(little) - 4, struct.pack("<i", -1)),
        "little_endian_length_negative.ply": with_bytes(
            ply("little_endian", length="char"), len(little) - 14, struct.pack("<b", -3)
        ),
        "little_endian_faces_are_numbers.ply": little.replace(b"list uchar int", b"int"),
        "little_endian_indices_without_sign.ply": little.replace(b"uchar int", b"uchar uint"),
        "big_endian_indices_without_sign.ply": big.replace(b"uchar int", b"uchar uint"),
        "little_endian_length_is_float.ply": ply("little_endian", length="float"),
        "little_endian_length_is_double.ply": ply("little_endian", length="double"),
        "little_endian_length_is_not_a_number.ply": with_bytes(
            ply("little_endian", length="float"),
            len(ply("little_endian", length="float")) - 16,
            struct.pack("<f", float("nan")),
        ),
        "little_endian_not_a_number.ply": with_bytes(little, body + 84, struct.pack("<f", float("nan"))),
        "little_endian_signalling_not_a_number.ply": with_bytes(little, body + 84, b"\1\0\x80\x7f"),
        "little_endian_first_byte_is_a_line_end.ply": with_bytes(little, body, b"\n"),
        "little_endian_header_of_windows.ply": little[:body].replace(b"\n", b"\r\n") + little[body:],
        "little_endian_header_with_cr.ply": little[:body].replace(b"\n", b"\r") + little[body:],
        "little_endian_saved_as_text.ply": little.replace(b"\n", b"\r\n"),
        "compressed_by_gzip.ply": gzip.compress(little, mtime=0),
    }


def obj_files() -> Mapping[str, bytes]:
    lines = [f"v {x:g} {y:g} {z:g}" for x, y, z in CUBE[0].tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (CUBE[1] + 1).tolist()]
    text = ("\n".join(lines) + "\n").encode()
    return {
        "compressed_by_gzip.obj": gzip.compress(text, mtime=0),
        "archive.obj": zipped("cube.obj", text),
        "binary_stl.obj": stl(),
        "binary_ply.obj": ply("little_endian"),
        "binary_gltf.obj": b"glTF" + struct.pack("<II", 2, 12),
        "picture.obj": b"\x89PNG\r\n\x1a\n" + bytes(200),
        "random_bytes.obj": np.random.default_rng(7).bytes(500),
    }


def usd_files() -> Mapping[str, bytes]:
    long = struct.pack("<Q", 1 << 40)
    return {
        "made_by_hand.usdc": crates.crate(),
        "bomb_nested_twenty_thousand.usdc": crates.nested(20_000),
        "bomb_dictionaries_twenty_thousand.usdc": crates.dictionaries(20_000),
        "bomb_dictionary_in_itself.usdc": crates.dictionaries(5, closed=True),
        "bomb_branches_that_meet.usdc": crates.crate([1] * 60 + [-2]),
        "bomb_array_of_a_million_million.usdc": crates.array(crates.FLOAT, 1 << 40),
        "bomb_packed_array_of_four_thousand_million.usdc": crates.array(
            crates.INT, 1 << 32, crates.number(20) + bytes(20), crates.PACKED
        ),
        "bomb_packed_zeros.usdc": crates.array(crates.INT, 1 << 27, crates.integers([0] * 500_000), crates.PACKED),
        "bomb_list_of_a_million_million.usdc": crates.held(crates.PATH_LIST, b"\x02" + long),
        "bomb_dictionary_of_a_million_million.usdc": crates.held(crates.DICTIONARY, long),
        "bomb_specs_of_eight_thousand_million.usdc": crates.crate(
            replaced={"SPECS": struct.pack("<Q", 1 << 33) + crates.integers([0])}
        ),
        "target_of_thirty_thousand_steps.usdc": crates.crate(tokens=(*crates.TOKENS, f"[{'/a' * 30_000}]")),
        "target_of_thirty_thousand_steps.usda": f'#usda 1.0\nover "a" {{ rel b = <{"/a" * 30_000}> }}\n'.encode(),
        "bomb_expression_of_brackets.usda": (
            f'#usda 1.0\nover "a" {{ pathExpression b = "{"(" * 100_000}/a{")" * 100_000}" }}\n'.encode()
        ),
        "kind_is_a_path_expression.usdc": crates.crate(
            tokens=(*crates.TOKENS[:4], "kind"), values={4: crates.value(57, 1, crates.INLINED)}
        ),
        "version_of_2016.usdc": crates.crate(version=(0, 3, 0)),
        "packed_wrongly.usdc": crates.crate(replaced={"PATHS": struct.pack("<4Q", 2, 2, 9, 0) + bytes(99)}),
    }


def main() -> None:
    """Write all of them."""
    kinds = {"stl": stl_files(), "ply": ply_files(), "obj": obj_files(), "usd": usd_files()}
    for kind, files in kinds.items():
        for name, data in files.items():
            (ROOT / kind).mkdir(parents=True, exist_ok=True)
            (ROOT / kind / name).write_bytes(data)


if __name__ == "__main__":
    main()
