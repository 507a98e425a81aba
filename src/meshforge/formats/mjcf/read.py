"""Reading an MJCF: from its files, through MuJoCo's compiled model, to an asset."""

from __future__ import annotations

from pathlib import Path

from meshforge.asset import Asset, Body
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.engine import compile_flat
from meshforge.formats.mjcf.flat import flatten
from meshforge.formats.mjcf.model import Reading
from meshforge.formats.mjcf.sources import gather


def read_mjcf(path: Path) -> Asset:
    """The asset in an MJCF, its includes and collision meshes taken in.

    Raises AssetError naming file and line: text that is not understood, an include or a collision mesh that is not
    there, a model that MuJoCo refuses for its collision geometry.
    """
    tree = gather(path)
    flat = flatten(tree)
    made = compile_flat(tree, flat)
    reading = Reading(flat, made)
    geoms, opaque = reading.pieces()
    return Asset(
        path=path,
        format="mjcf",
        bodies=tuple(Body(body.name, body.pose) for body in reading.bodies),
        geoms=geoms,
        document=MjcfDocument(tree.sources, reading.authored(), reading.bodies),
        opaque=opaque,
    )
