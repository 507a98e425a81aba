"""What a user should know about how a stage was read."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.formats.usd.reading.colliders import COLLISION, TRIGGER, applies, collides
from meshforge.formats.usd.reading.stage import Scene
from meshforge.words import counted, listed


def scene_notes(scene: Scene, physics: bool) -> Iterator[str]:
    """The notes on a stage; physics: whether its prims say what collides."""
    if not physics:
        yield "no prim is marked as collision: all that is seen is taken for it, so that edits change what is seen"
    prims = list(scene.prims())
    off = [p.GetName() for p in prims if applies(p, COLLISION) and not applies(p, TRIGGER) and not collides(scene, p)]
    if off:
        yield f"{counted(len(off), 'collider')} switched off are left as they are ({listed(off, 3)})"
    triggers = sum(applies(prim, TRIGGER) for prim in prims)
    if triggers:
        yield f"{counted(triggers, 'trigger')} detect bodies without colliding: they are left as they are"
    if chosen := [prim.GetName() for prim in prims if prim.HasVariantSets()]:
        yield f"of variants, the selected ones are read ({listed(chosen, 3)})"
    if sum(prim.IsInstance() for prim in prims):
        yield "what an edit changes in an instance becomes that instance's own: it is no longer shared"
