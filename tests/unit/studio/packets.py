"""Reads packets as the page does, by what the contract says alone."""

import json
import struct
from typing import Any

import numpy as np

from meshforge.geometry import Floats, Ints


def read_packet(packet: bytes) -> tuple[dict[str, Any], list[tuple[Floats, Ints]]]:
    """The header, and vertices and triangles of each row."""
    (length,) = struct.unpack_from("<I", packet)
    assert length % 4 == 0
    header: dict[str, Any] = json.loads(packet[4 : 4 + length])
    rows = header["rows"]
    points = sum(row["vertices"] for row in rows)
    vertices = np.frombuffer(packet, "<f4", 3 * points, 4 + length).reshape(-1, 3).astype(float)
    faces = np.frombuffer(packet, "<u4", offset=4 + length + 12 * points).reshape(-1, 3).astype(int)
    assert len(faces) == sum(row["faces"] for row in rows)
    shapes = []
    for row in rows:
        shapes.append((vertices[: row["vertices"]], faces[: row["faces"]]))
        vertices, faces = vertices[row["vertices"] :], faces[row["faces"] :]
    return header, shapes
