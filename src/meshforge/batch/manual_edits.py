"""What a person decided on one asset: hulls that rules select there, and edits by hand, replayed after the program."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from meshforge import language, symbolic
from meshforge.batch.provenance import text_digest
from meshforge.geometry import digest


@dataclass(frozen=True, slots=True)
class RuleSelection:
    """What a rule selected on an asset, or is to select there; action: what it does, by `action_text_without_each`."""

    rule: int
    action: str
    select: tuple[str, ...]


def action_text_without_each(action: language.Action, label: str | None) -> str:
    """Return what a rule does, in the language's text, whether to all hulls together or to each."""
    return action_text(action.action if isinstance(action, language.Each) else action, label)


def action_text(action: language.Action, label: str | None) -> str:
    """Return an action as a rule has it after its arrow: `Add(+X, "knob.obj") as handle`."""
    return f"{action} as {language.show_label(label)}" if label else str(action)


def selections_of(meant: Iterable[RuleSelection], program: language.Program) -> dict[int, frozenset[str]]:
    """Return what rules of a program are to select on an asset, by their numbers; nothing where its rules do something
    else than those that a person spoke of."""
    known = {one.rule: one for one in meant}
    actions = {k: action_text_without_each(rule.action, rule.label) for k, rule in enumerate(program.rules, 1)}
    if {number: one.action for number, one in known.items()} != actions:
        return {}
    return {number: frozenset(one.select) for number, one in known.items()}


def selections_digest(meant: Iterable[RuleSelection]) -> str | None:
    """Return the digest of what rules are to select, None where nobody said so."""
    lines = [f"{one.rule} {one.action} {sorted(one.select)}" for one in meant]
    return text_digest("\n".join(lines)) if lines else None


@dataclass(frozen=True, slots=True)
class ManualEdit:
    """One edit by hand. hulls: name and digest of each hull it is about; label: of what it makes, None keeps it."""

    hulls: tuple[tuple[str, str], ...]
    action: language.Action
    label: str | None = None

    def __str__(self) -> str:
        names = ", ".join(f"{name} ({known})" for name, known in self.hulls)
        return f"{names} => {self.action}" + (f" as {language.show_label(self.label)}" if self.label else "")

    def find_problem(self, mesh: symbolic.SymbolicMesh) -> str | None:
        """Return why this edit cannot be replayed on a mesh, None where it can."""
        for name, known in self.hulls:
            if name not in mesh.index:
                return f"{name} is gone"
            if digest(mesh.hull_of(name).shape) != known:
                return f"{name} has another shape now"
        return None


def replay_manual_edits(
    manual_edits: Iterable[ManualEdit],
    source: symbolic.SymbolicMesh,
    edited: symbolic.SymbolicMesh,
    program: language.Program,
    templates: Mapping[str, language.Template],
) -> tuple[symbolic.SymbolicMesh, tuple[str, ...]]:
    """Return the mesh that a program made of `source`, after edits by hand; and a sentence for each that was left out.

    The edits see the mesh in the program's canonical frame, as its rules do.
    """
    manual_edits = tuple(manual_edits)
    if not manual_edits:
        return edited, ()
    replay = language.Replay.begin(source, program.orient, program.contact)
    staged, known = replay.mesh, replay.mesh.index
    current = staged.with_hulls(
        staged.hulls[known[h.name]].with_label(h.annotation) if h.name in known else h.move(replay.pose)
        for h in edited.hulls
    )
    replay, flags = replace(replay, mesh=current, used=frozenset(edited.index)), []
    for number, manual_edit in enumerate(manual_edits, 1):
        lost = manual_edit.find_problem(_restore_program_hulls(replay.mesh, edited))
        if lost:
            flags.append(f"edit {number} by hand was left out: {lost}")
            continue
        mask = replay.mask_of(name for name, _ in manual_edit.hulls)
        replay = replay.apply(mask, manual_edit.action, manual_edit.label, templates)
    return _restore_program_hulls(replay.edited, edited), tuple(flags)


def _restore_program_hulls(mesh: symbolic.SymbolicMesh, edited: symbolic.SymbolicMesh) -> symbolic.SymbolicMesh:
    """The mesh with the program's own hulls where they stayed, so that turning there and back leaves no rounding."""
    hulls = (edited.hull_of(h.name).with_label(h.annotation) if h.name in edited.index else h for h in mesh.hulls)
    return replace(mesh, hulls=tuple(hulls))


def manual_edits_digest(manual_edits: Iterable[ManualEdit]) -> str | None:
    """Return the digest of edits by hand, None where there are none."""
    lines = [str(manual_edit) for manual_edit in manual_edits]
    return text_digest("\n".join(lines)) if lines else None
