"""Geometry compressed by Draco (KHR_draco_mesh_compression), decoded by Google's library."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from meshforge.formats.meshfile.gltf.items import Json
from meshforge.geometry import Ints

NAME = "KHR_draco_mesh_compression"


@dataclass(frozen=True, eq=False, slots=True)
class Decoded:
    """The triangles (m, 3) of a primitive, and the attributes that were compressed, each (n, k), by their names."""

    faces: Ints
    attributes: dict[str, npt.NDArray[Any]]


def decoded(data: bytes, names: Json) -> Decoded:
    """What the bytes of a compressed primitive hold; names: the number of each attribute by its name.

    Raises ValueError: they are damaged, hold no triangles, or not all of the attributes.
    """
    import DracoPy

    try:
        mesh = DracoPy.decode(data)
    except Exception as error:  # DracoPy raises several kinds, none of which tells more
        raise ValueError(f"its Draco data is damaged: {error}") from error
    if not hasattr(mesh, "faces"):
        raise ValueError("its Draco data holds points without triangles")
    by_number = {attribute["unique_id"]: attribute["data"] for attribute in mesh.attributes}
    missing = [name for name, number in names.items() if number not in by_number]
    if missing:
        raise ValueError(f"its Draco data has no {missing[0]}")
    found = {name: np.asarray(by_number[number]) for name, number in names.items()}
    rows = {len(values) for values in found.values()}
    if len(rows) > 1:
        raise ValueError("its Draco data holds attributes of several lengths")
    return Decoded(np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3), found)
