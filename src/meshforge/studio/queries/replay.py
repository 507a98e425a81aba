"""Replays the steps of an asset one by one: what it is after each of them, and what each did."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from meshforge import language
from meshforge.common import DemonstrationError, MeshForgeError, ProgramError, suggest_name
from meshforge.geometry import Pose
from meshforge.language import EXTREMITY, Action, Program, Rule, Template, orient_mesh, select_mask
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh, bits_of, mask_of
from meshforge.synthesis import Demonstration, Step, begin_replay, memoize, strip_each


@dataclass(frozen=True, slots=True)
class EditResult:
    """What one edit did. selected, made, removed: names of hulls; note: what a user should know; error: why it did
    nothing."""

    rule: int
    selected: tuple[str, ...] = ()
    made: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    note: str | None = None
    error: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class AssetReplay:
    """An asset and the edits so far. source: as it comes; pose: canonical_T_incoming; start: turned so.

    mesh: as it is now, in the canonical frame; used: names that no made hull may take again.
    """

    asset: str
    source: SymbolicMesh
    pose: Pose
    start: SymbolicMesh
    mesh: SymbolicMesh
    used: frozenset[str] = frozenset()
    results: tuple[EditResult, ...] = ()

    @property
    def incoming_mesh(self) -> SymbolicMesh:
        """The asset as it is now, in the frame it comes in."""
        return language.from_canonical_frame(self.source, self.mesh, self.pose)

    def mask_of(self, names: Iterable[str]) -> int:
        """Hulls by name as a bit set. Raises DemonstrationError for one that is not there."""
        names = sorted(names)
        for name in names:
            if name not in self.mesh.index:
                raise self._unknown_hull(name)
        return mask_of(self.mesh.index[name] for name in names)

    def apply(
        self, mask: int, action: Action, label: str | None, templates: Mapping[str, Template], *, again: bool = False
    ) -> AssetReplay:
        """After one more edit, of the hulls of a bit set. again: whether the same edit will be replayed again."""
        number = len(self.results) + 1

        def change() -> _Change:
            done = language.apply_action(self.mesh, mask, action, templates, label, self.used)
            return _Change(None if done.mesh is self.mesh else done.mesh, done.made, done.note, done.used)

        is_cached = again and not action.templates  # files may change
        key = (mask, action, label, self.used)
        try:
            done = memoize(self.mesh, key, _Change, change) if is_cached else change()
        except MeshForgeError as error:
            raise error.at(f"{self.asset}, rule {number}") from None
        mesh = done.mesh or self.mesh
        selected = tuple(self.mesh.hulls[k].name for k in sorted(bits_of(mask)))
        gone = tuple(hull.name for hull in self.mesh.hulls if hull.name not in mesh.index)
        result = EditResult(number, selected, done.made, gone, done.note)
        return replace(self, mesh=mesh, used=done.used, results=(*self.results, result))

    def skip(self, error: MeshForgeError) -> AssetReplay:
        """After an edit that fails and is left out."""
        return replace(self, results=(*self.results, EditResult(len(self.results) + 1, error=error.message)))

    def _unknown_hull(self, name: str) -> DemonstrationError:
        where = f"{self.asset}, rule {len(self.results) + 1}"
        if name in self.source.index or name in self.used:
            return DemonstrationError(
                f"the hull {name!r} is gone: an earlier rule removed or replaced it",
                where=where,
                remedy="Select what that rule made, or change the order of the steps.",
            )
        return DemonstrationError(f"there is no hull {name!r}", where=where, remedy=suggest_name(name, self.mesh.index))


@dataclass(frozen=True, eq=False, slots=True)
class _Change:
    """An applied action; mesh: None where it stayed the same, so that a cached change does not keep its mesh alive."""

    mesh: SymbolicMesh | None
    made: tuple[str, ...]
    note: str | None
    used: frozenset[str]


def replay_steps(project: Project, asset: str, mesh: SymbolicMesh, steps: int | None = None) -> AssetReplay:
    """An asset after its first steps, all by default; a step that fails is left out, and its result has the error.

    A step without a selection does what the rule of its number does in the present program, as in learning, or nothing
    without such a rule. Raises ProgramError where the orientation does not turn the asset.
    """
    orient, contact = project.orientation, project.settings.thresholds.contact
    start = begin_replay(asset, Demonstration(mesh, (), asset), orient, contact).mesh
    pose = memoize(mesh, ("pose", orient), Pose, lambda: orient_mesh(mesh, orient)[1])
    replay = AssetReplay(asset, mesh, pose, start, start)
    try:
        program = project.program() or Program()
    except ProgramError:
        program = Program()
    for step in project.steps(asset)[:steps]:
        try:
            replay = _apply_step(project, replay, step, program)
        except MeshForgeError as error:
            replay = replay.skip(error)
    return replay


def _apply_step(project: Project, replay: AssetReplay, step: Step, program: Program) -> AssetReplay:
    action, label = step.action, step.label
    if step.select is not None:
        mask = replay.mask_of(step.select)
    else:
        rule = _rule_of(program, step)
        if rule is None:
            return replace(replay, results=(*replay.results, EditResult(step.rule)))
        mask = select_mask(rule.extractor, replay.mesh, program.extremity or EXTREMITY)
        action, label = rule.action, rule.label
    return replay.apply(mask, action, label, project.templates(action.templates), again=True)


def _rule_of(program: Program, step: Step) -> Rule | None:
    rules = program.rules[step.rule - 1 : step.rule]
    return next((r for r in rules if (strip_each(r.action), r.label) == (strip_each(step.action), step.label)), None)
