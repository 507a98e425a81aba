"""What a made hull inherits from the largest of the hulls it is made from, where these differ."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.language.actions import Made
from meshforge.symbolic import SymbolicMesh
from meshforge.words import listed


def inheritance_notes(made: Iterable[Made], mesh: SymbolicMesh) -> list[str]:
    """A sentence for each hull whose sources differ in contact attributes: it takes those of the largest."""
    known = {geom.name: dict(geom.contact) for geom in mesh.asset.geoms if geom.contact} if mesh.asset else {}
    return [note for one in made if known and (note := _note(one, known))]


def _note(made: Made, known: dict[str, dict[str, str]]) -> str | None:
    values = [known[name] for hull in made.sources if (name := hull.parent or hull.name) in known]
    names = dict.fromkeys(name for each in values for name in each)
    differing = [name for name in names if len({each.get(name) for each in values}) > 1]
    return f"{listed(differing)} as {made.heir.name} has it; the hulls beside it have another" if differing else None
