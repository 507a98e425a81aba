"""An asset in the midst of edits: what it is now, and what each edit did."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from meshforge.errors import DemonstrationError, MeshForgeError, nearest
from meshforge.geometry import Pose
from meshforge.language import Action, Applied, Template, apply_action, unstage
from meshforge.symbolic import SymbolicMesh, bits, mask_of
from meshforge.synthesis.remember import remembered


@dataclass(frozen=True, slots=True)
class Deed:
    """What one edit did. selected, made, removed: names of hulls; note: what a user should know; error: why it did
    nothing."""

    rule: int
    selected: tuple[str, ...] = ()
    made: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    note: str | None = None
    error: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """An asset and the edits so far. source: as it comes; pose: canonical_T_incoming; start: turned so.

    mesh: as it is now, in the canonical frame; used: names that no made hull may take again.
    """

    asset: str
    source: SymbolicMesh
    pose: Pose
    start: SymbolicMesh
    mesh: SymbolicMesh
    used: frozenset[str] = frozenset()
    results: tuple[Deed, ...] = ()

    @property
    def incoming_mesh(self) -> SymbolicMesh:
        """The asset as it is now, in the frame it comes in."""
        return unstage(self.source, self.mesh, self.pose)

    def mask_of(self, names: Iterable[str]) -> int:
        """Hulls by name as a bit set. Raises DemonstrationError for one that is not there."""
        names = sorted(names)
        for name in names:
            if name not in self.mesh.index:
                raise self._unknown_hull(name)
        return mask_of(self.mesh.index[name] for name in names)

    def apply(
        self, mask: int, action: Action, label: str | None, templates: Mapping[str, Template], *, again: bool = False
    ) -> Course:
        """After one more edit, of the hulls of a bit set. again: whether it will be asked for once more."""
        number = len(self.results) + 1

        def change() -> _Change:
            return _Change.of(self.mesh, apply_action(self.mesh, mask, action, templates, label, self.used))

        kept = again and not action.templates  # files may change
        key = (mask, action, label, self.used)
        try:
            done = remembered(self.mesh, key, _Change, change) if kept else change()
        except MeshForgeError as error:
            raise error.at(f"{self.asset}, rule {number}") from None
        mesh = done.mesh or self.mesh
        selected = tuple(self.mesh.hulls[k].name for k in sorted(bits(mask)))
        gone = tuple(hull.name for hull in self.mesh.hulls if hull.name not in mesh.index)
        deed = Deed(number, selected, done.made, gone, done.note)
        return replace(self, mesh=mesh, used=done.used, results=(*self.results, deed))

    def skip(self, error: MeshForgeError) -> Course:
        """After an edit that cannot be done, and is left out."""
        return replace(self, results=(*self.results, Deed(len(self.results) + 1, error=error.message)))

    def _unknown_hull(self, name: str) -> DemonstrationError:
        where = f"{self.asset}, rule {len(self.results) + 1}"
        if name in self.source.index or name in self.used:
            return DemonstrationError(
                f"the hull {name!r} is gone: an earlier rule removed or replaced it",
                where=where,
                remedy="Select what that rule made, or change the order of the steps.",
            )
        like = nearest(name, self.mesh.index)
        remedy = f"Did you mean {like!r}?" if like else None
        return DemonstrationError(f"there is no hull {name!r}", where=where, remedy=remedy)


@dataclass(frozen=True, eq=False, slots=True)
class _Change:
    """An applied action without its mesh where that stayed the same, so that what remembers it can go with the mesh."""

    mesh: SymbolicMesh | None
    made: tuple[str, ...]
    note: str | None
    used: frozenset[str]

    @staticmethod
    def of(before: SymbolicMesh, applied: Applied) -> _Change:
        mesh = None if applied.mesh is before else applied.mesh
        return _Change(mesh, applied.made, applied.note, applied.used)
