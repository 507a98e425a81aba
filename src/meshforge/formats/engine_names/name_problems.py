"""Names that were meant to mark collision for an engine, and do not."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence

from meshforge.common import nearest_name
from meshforge.formats.engine_names.conventions import COLLIDERS, godot_kind, holds_colliders, unreal_kind
from meshforge.symbolic import NameProblem

_ALIKE = 0.82  # how alike the end of a name and a mark are, from which on it was meant: `colony` and `colonly` are 0.92
_GODOT = ("convcolonly", "colonly", "convcol")
_UNREAL = re.compile(r"(?:UCX|UBX|UXC|UXB)(?=[^a-z])")
_MARKS: Mapping[str, Callable[[str], object]] = {"unreal": unreal_kind, "godot": godot_kind, "unity": holds_colliders}
_CHANGED = re.compile(r"[^\w-]+")  # in Unreal an underscore
_REMEDY = "Is {} meant? Spell it so."


def find_name_problems(
    meshes: Iterable[Sequence[str]], parents: Collection[str] = (), marks: str = "", hull: str = ""
) -> Iterator[NameProblem]:
    """Yield what is wrong with the names of meshes and of their nodes, several of one thing, and of nodes without a
    mesh. marks: the engine whose marks are read, if any; hull: the first hull by them."""
    things = [names for names in meshes if names]
    every = [*parents, *(name for names in things for name in names)]
    for engine in (one for one, bears in _MARKS.items() if marks in _MARKS and not any(map(bears, every))):
        title = engine.capitalize()
        problem = f"{title} takes no mark of {marks.capitalize()}, so that nothing collides by it"
        remedy = f"Mark it for {title}: meshforge convert FILE OUT --names {engine}."
        yield NameProblem(engine, hull, problem, remedy, is_hull=True)
    seen = [name for names in things if not any(map(unreal_kind, names)) for name in names]
    known = {_CHANGED.sub("_", name.lower()) for name in seen}
    for own in (next(filter(unreal_kind, names)) for names in things if any(map(unreal_kind, names))):
        whole = _CHANGED.sub("_", own[4:])
        wanted = whole.rpartition("_")[0] or whole
        if known.isdisjoint((whole.lower(), wanted.lower())):
            nearest = nearest_name(wanted, seen) or next(iter(seen), wanted)
            problem = f"no mesh is called {wanted}, so that in Unreal nothing collides by it"
            rename = f"The nearest mesh is {nearest}: call it {own[:4]}{nearest}_00."
            remedy = rename if seen else f"There is no mesh to be seen: add {wanted}."
            yield NameProblem("unreal", own, problem, remedy, is_hull=True)
    for name in filter(_UNREAL.match, dict.fromkeys(seen)):
        yield NameProblem("unreal", name, remedy=_REMEDY.format("UCX_" if "C" in name[:3] else "UBX_"))
    for names in things:
        meant = [mark for name in names for mark in _find_meant(name, _GODOT) if not any(map(godot_kind, names))]
        yield from (NameProblem("godot", names[0], remedy=_REMEDY.format(f"-{mark}")) for mark in meant[:1])
    for name in parents:
        if not holds_colliders(name) and _find_meant(name, [COLLIDERS[1:]]):
            yield NameProblem("unity", name, remedy=_REMEDY.format(COLLIDERS))


def _find_meant(name: str, marks: Sequence[str]) -> list[str]:
    words = re.split(r"[-_$. ]+", re.sub(r"[0-9\x00-\x20_.]+\Z", "", name).lower())
    ends = ["".join(words[-2:]), words[-1]] if len(words) > 1 else []
    close = [mark for end in ends for mark in difflib.get_close_matches(end, marks, 1, _ALIKE)]
    return close or [mark for mark in marks if words[-1].endswith(mark)]
