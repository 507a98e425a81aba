"""Reading an MJCF: from its files, through MuJoCo's compiled model, to an asset."""

from __future__ import annotations

from pathlib import Path

from meshforge.asset import Asset, Body
from meshforge.errors import AssetError
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.files.excess import refuse_excess
from meshforge.formats.mjcf.files.flat import Flat, flatten
from meshforge.formats.mjcf.files.fragments import gather_model
from meshforge.formats.mjcf.files.references import referenced
from meshforge.formats.mjcf.files.sources import Tree
from meshforge.formats.mjcf.reading.engine import Compiled, compile_flat
from meshforge.formats.mjcf.reading.mechanism import read_mechanism
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.reading.reduce import reduced
from meshforge.formats.mjcf.reading.visuals import read_visuals
from meshforge.words import counted


def read_mjcf(path: Path) -> Asset:
    """The asset in an MJCF, its includes and collision meshes taken in.

    Raises AssetError naming file and line: text that is not understood, an include or a collision mesh that is not
    there, a model whose collision geometry MuJoCo refuses too.
    """
    tree = gather_model(path)
    refuse_excess(tree)
    flat, made, stand_ins, refusal = _compiled(tree)
    reading = Reading(tree, flat, made)
    geoms, opaque = reading.read_pieces()
    files, missing = referenced(tree)
    return Asset(
        path=path,
        format="mjcf",
        bodies=tuple(Body(body.name, body.pose) for body in reading.bodies),
        geoms=geoms,
        document=MjcfDocument(tree.sources, reading.geom_records(), reading.bodies, refusal),
        opaque=opaque,
        visuals=read_visuals(reading, made.spec, stand_ins),
        files=files,
        missing=missing,
        notes=_notes(tree, made, refusal),
        mechanism=read_mechanism(reading),
    )


def _compiled(tree: Tree) -> tuple[Flat, Compiled, frozenset[int], str]:
    """The text and what MuJoCo makes of it, of the collision geometry alone where it refuses the whole, and why."""
    flat = flatten(tree)
    try:
        made = compile_flat(tree, flat)
    except AssetError as error:
        part = reduced(tree, error)
        return part.flat, part.made, part.stand_ins, _refusal(error)
    return flat, made, frozenset(), ""


def _refusal(error: AssetError) -> str:
    """What is wrong, with the name and line of the file where they are known."""
    place = Path(error.where or "").name
    return f"{error.problem} ({place})" if ":" in place else error.problem


def _notes(tree: Tree, made: Compiled, refusal: str) -> tuple[str, ...]:
    notes = [f"{refusal}; read for its collision geometry only"] if refusal else []
    notes += [f"MuJoCo refuses this file: {fault}" for fault in tree.faults]
    notes += [f"MuJoCo warns: {warning}" for warning in made.warnings]
    if made.model.nflex:
        notes.append(
            f"{counted(int(made.model.nflex), 'flexible body', 'flexible bodies')}: no hulls, left as authored"
        )
    return tuple(notes)
