"""The replay of edits on a mesh, one after the other, in the canonical frame; and the way into that frame and back."""

from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol, Self, TypeVar

import numpy as np

from meshforge import geometry
from meshforge.common import DemonstrationError, MeshForgeError, suggest_name
from meshforge.language.actions.base import Action
from meshforge.language.actions.edit import Template
from meshforge.language.actions.misfit import Misfit
from meshforge.language.apply import ActionResult, apply_action
from meshforge.language.extractors.base import select_mask
from meshforge.language.hull_table import EXTREMITY
from meshforge.language.orient import Orient, orient_mesh
from meshforge.language.print import Rule
from meshforge.symbolic import Hull, SymbolicMesh, mask_of

Value = TypeVar("Value")


class Memo(Protocol):
    """Gives what `make` makes for a mesh and a key; where that was asked before, what was made then."""

    def __call__(self, mesh: SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]) -> Value: ...


def make_anew(mesh: SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]) -> Value:
    """Return the memo that keeps nothing."""
    return make()


@dataclass(frozen=True, slots=True)
class RuleTrace:
    """What one rule did on a mesh; rule: its number from 1; selected, made, removed: names of hulls.

    sources: for each made hull, the names of the hulls it was made from; note: what a user should know; error: why it
    was skipped; misfits: how primitives that it made differ from what they replace.
    """

    rule: int
    selected: tuple[str, ...] = ()
    made: tuple[str, ...] = ()
    note: str | None = None
    sources: tuple[tuple[str, ...], ...] = ()
    removed: tuple[str, ...] = ()
    error: str | None = None
    misfits: tuple[Misfit, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Replay:
    """A mesh after some edits.

    source: as it comes; pose: canonical_T_incoming; start: before the edits, and mesh: after them, in the canonical
    frame; name: how errors call it; selections: names of hulls that rules select whatever their extractors do, by
    their numbers; trace: what each edit did; used: names that no made hull may take again; memo: keeps what edits made.
    """

    source: SymbolicMesh
    pose: geometry.Pose
    start: SymbolicMesh
    mesh: SymbolicMesh
    name: str = ""
    selections: Mapping[int, Collection[str]] = field(default_factory=dict)
    trace: tuple[RuleTrace, ...] = ()
    used: frozenset[str] = frozenset()
    memo: Memo = make_anew

    @classmethod
    def begin(
        cls,
        mesh: SymbolicMesh,
        orient: Orient | None = None,
        contact: float | None = None,
        *,
        name: str = "",
        selections: Mapping[int, Collection[str]] | None = None,
        memo: Memo = make_anew,
    ) -> Self:
        """Return a mesh before its first edit. Raises ProgramError where it cannot be turned."""
        try:
            start, pose = to_canonical_frame(mesh, orient, contact, memo)
        except MeshForgeError as error:
            raise (error.at(name) if name else error) from None
        return cls(mesh, pose, start, start, name, selections or {}, memo=memo)

    @property
    def edited(self) -> SymbolicMesh:
        """The mesh as it is now, in the frame it came in; the very same object where nothing changed."""
        return from_canonical_frame(self.source, self.mesh, self.pose)

    @property
    def number(self) -> int:
        """The number of the next edit, from 1."""
        return len(self.trace) + 1

    @property
    def is_given(self) -> bool:
        """Whether it is known what the next rule selects, whatever its extractor does."""
        return self.number in self.selections

    def mask_of(self, names: Iterable[str]) -> int:
        """Return hulls by name as a bit set. Raises DemonstrationError for one that is not there."""
        names = sorted(names)
        for name in names:
            if name not in self.mesh.index:
                raise self._unknown_hull(name)
        return mask_of(self.mesh.index[name] for name in names)

    def select(self, rule: Rule, extremity: float | None = None) -> int:
        """Return the bit set of what the next rule selects, or is given to select."""
        if self.is_given:
            return self.mask_of(self.selections[self.number])
        return select_mask(rule.extractor, self.mesh, EXTREMITY if extremity is None else extremity)

    def advance(self, rule: Rule, templates: Mapping[str, Template], extremity: float | None = None) -> Self:
        """Return after one more rule. Raises MeshForgeError where it cannot be done."""
        return self.apply(self.select(rule, extremity), rule.action, rule.label, templates)

    def apply(self, mask: int, action: Action, label: str | None, templates: Mapping[str, Template]) -> Self:
        """Return after one more action, on the hulls of a bit set. Raises MeshForgeError where it cannot be done."""
        try:
            done = self._act(mask, action, label, templates)
        except MeshForgeError as error:
            raise (error.at(f"{self.name}, rule {self.number}") if self.name else error) from None
        mesh = done.mesh or self.mesh
        removed = tuple(hull.name for hull in self.mesh.hulls if hull.name not in mesh.index) if done.mesh else ()
        names, misfits = self.mesh.names_of(mask), done.misfits
        line = RuleTrace(self.number, names, done.made, done.note, done.sources, removed, misfits=misfits)
        return replace(self, mesh=mesh, used=done.used, trace=(*self.trace, line))

    def skip(self, error: str | None = None) -> Self:
        """Return after an edit that is left out, and why."""
        return replace(self, trace=(*self.trace, RuleTrace(self.number, error=error)))

    def _act(self, mask: int, action: Action, label: str | None, templates: Mapping[str, Template]) -> ActionResult:
        def act() -> ActionResult:
            return apply_action(self.mesh, mask, action, templates, label, self.used)

        if not mask or any(name not in templates for name in action.templates):  # nothing to do, or it fails
            return act()
        made_of = tuple(templates[name].digest for name in action.templates)
        return self.memo(self.mesh, (mask, action, label, self.used, made_of), ActionResult, act)

    def _unknown_hull(self, name: str) -> DemonstrationError:
        where = f"{self.name}, rule {self.number}" if self.name else None
        if name in self.source.index or name in self.used:
            problem = f"the hull {name!r} is gone: an earlier rule removed or replaced it"
            remedy = "Select what that rule made, or change the order of the steps."
            return DemonstrationError(problem, where=where, remedy=remedy)
        return DemonstrationError(f"there is no hull {name!r}", where=where, remedy=suggest_name(name, self.mesh.index))


def to_canonical_frame(
    mesh: SymbolicMesh, orient: Orient | None, contact: float | None = None, memo: Memo = make_anew
) -> tuple[SymbolicMesh, geometry.Pose]:
    """Return the mesh as the first rule sees it: oriented, with L fixed; and the pose oriented_T_incoming.

    contact: the program's epsilon, None keeps the mesh's.
    """
    staged, pose = memo(mesh, (orient, contact), tuple, lambda: _to_canonical_frame(mesh, orient, contact))
    return staged, pose


def _to_canonical_frame(
    mesh: SymbolicMesh, orient: Orient | None, contact: float | None
) -> tuple[SymbolicMesh, geometry.Pose]:
    oriented, pose = orient_mesh(mesh, orient)
    staged = replace(oriented, epsilon=mesh.epsilon if contact is None else contact, scale=oriented.diagonal)
    if oriented.known_graph is not None and staged.contact_distance == oriented.contact_distance:
        staged.set_known_graph(oriented.known_graph)  # the same shapes and reach
    return staged, pose


def from_canonical_frame(incoming: SymbolicMesh, staged: SymbolicMesh, pose: geometry.Pose) -> SymbolicMesh:
    """Return an edited mesh in the frame it came in, the inverse of `to_canonical_frame`."""
    back = pose.inverse()
    turned = not np.array_equal(pose.rotation, np.eye(3))
    hulls = tuple(_restore_hull(incoming, hull, back if turned else None) for hull in staged.hulls)
    same = incoming.scale is None and len(hulls) == len(incoming.hulls)
    if same and all(a is b for a, b in zip(hulls, incoming.hulls, strict=True)):
        return incoming
    return replace(incoming, hulls=hulls, scale=None)


def _restore_hull(incoming: SymbolicMesh, hull: Hull, back: geometry.Pose | None) -> Hull:
    """A hull in the incoming frame: the original where it was kept, relabelled where the program did so."""
    if hull.name in incoming.index:
        original = incoming.hull_of(hull.name)
        return original if original.annotation == hull.annotation else original.with_label(hull.annotation)
    return hull.move(back) if back else hull
