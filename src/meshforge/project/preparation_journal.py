"""What preparation steps changed of selections and labels, kept so that undoing them brings it back bit for bit.

Beside the preparation, `selections.json` keeps for each of its steps what demonstrations, answers and edits by hand
said before and after it, and the labels. It is written first and shortened last: a step in it that the preparation has
not was cut short, and what it changed is restored before anything else is done.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from meshforge import store as files
from meshforge import symbolic
from meshforge.project import selections
from meshforge.store import Store


class StepSelections(files.JsonFile):
    """What one preparation step changed. place: how many steps were before it; labels_before, labels_after: the
    text of the labels file, null for none; labels_between: its texts while labels of both are in it, of doing the step
    and of undoing it."""

    place: int
    parts: dict[str, tuple[str, ...]]
    digests: dict[str, str]
    changes: tuple[selections.SelectionChange, ...] = ()
    labels_before: str | None
    labels_between: tuple[str | None, ...]
    labels_after: str | None

    @property
    def successors(self) -> selections.Successors:
        return selections.Successors(self.parts, self.digests)


class SelectionsFile(files.JsonFile):
    """prepared/ID/selections.json: the steps that changed something, in order."""

    steps: tuple[StepSelections, ...] = ()


@dataclass(frozen=True, slots=True)
class LabelsText:
    """What a labels file says; None for no file."""

    text: str | None


def read_journal(store: Store, asset: str) -> tuple[StepSelections, ...]:
    """What the steps of a preparation changed. Raises ProjectError where the file is damaged."""
    found = files.read_json(store.layout.preparation_journal(asset), SelectionsFile)
    return found.steps if found else ()


def write_journal(store: Store, asset: str, steps: Sequence[StepSelections]) -> None:
    """Write what steps changed; without any the file is removed, and its folder where that is empty then."""
    path: Path = store.layout.preparation_journal(asset)
    if steps:
        files.write_json(path, SelectionsFile(steps=tuple(steps)))
        return
    path.unlink(missing_ok=True)
    if path.parent.is_dir() and not any(path.parent.iterdir()):
        path.parent.rmdir()


def read_labels_text(store: Store, asset: str) -> LabelsText:
    """What the labels file of an asset says, damaged or not."""
    return LabelsText(store.label_bytes(asset).decode("utf-8", "replace") or None)


def describe_step(
    store: Store,
    asset: str,
    place: int,
    successors: selections.Successors,
    labels: tuple[LabelsText, LabelsText, LabelsText],
) -> StepSelections | None:
    """What a step changes that splits hulls, None where it changes nothing. labels: before, between and after it.

    Nothing is written yet. Raises ProjectError where a file cannot be read.
    """
    changes = selections.carry_selections(store, asset, successors) if successors.parts else ()
    before, between, after = (one.text for one in labels)
    if not changes and (not successors.parts or before == after):
        return None
    return StepSelections(
        place=place,
        parts=dict(successors.parts),
        digests=dict(successors.digests),
        changes=changes,
        labels_before=before,
        labels_between=(between,),
        labels_after=after,
    )


@dataclass(frozen=True, slots=True)
class JournalChange:
    """What an exchange of preparations does to the journal and to selections, under the lock that the caller holds.

    kept: the steps that stay; undone: those that are undone, the last one first; step: the one that is done.
    """

    store: Store
    asset: str
    kept: tuple[StepSelections, ...]
    undone: tuple[StepSelections, ...]
    step: StepSelections | None = None

    @staticmethod
    def at(store: Store, asset: str, place: int) -> JournalChange:
        """The change that undoes all steps from a place on. Raises ProjectError where the journal is damaged."""
        steps = read_journal(store, asset)
        undone = tuple(step for step in reversed(steps) if step.place >= place)
        return JournalChange(store, asset, tuple(step for step in steps if step.place < place), undone)

    def write_before(self, between: LabelsText | None) -> None:
        """Note what is to be done, before anything is. between: what the labels file says meanwhile where undoing
        restores it, None where it does not."""
        undone = list(self.undone)
        if between and undone and between.text not in undone[0].labels_between:
            texts = (*undone[0].labels_between, between.text)
            undone[0] = undone[0].model_copy(update={"labels_between": texts})
        if self.step or undone != list(self.undone):
            steps = [*self.kept, *reversed(undone), *([self.step] if self.step else [])]
            write_journal(self.store, self.asset, steps)

    def exchange_selections(self) -> None:
        """Let selections name the hulls that there are now."""
        _restore_selections(self.store, self.asset, self.undone)
        selections.apply_changes(self.store, self.asset, self.step.changes if self.step else ())

    def write_after(self) -> None:
        """Note that all is done."""
        write_journal(self.store, self.asset, [*self.kept, *([self.step] if self.step else [])])


def finish_undo(store: Store, asset: str, place: int) -> bool:
    """Restore what selections and labels were before all steps from a place on, under the lock that the caller holds;
    whether there were such steps. Killed in between, it can be done again.

    Raises ProjectError where a file cannot be read; then nothing is written.
    """
    change = JournalChange.at(store, asset, place)
    if not change.undone:
        return False
    selections.check_selections(store, asset)
    restored = restore_labels_text(read_labels_text(store, asset), change.undone)
    change.exchange_selections()
    if restored:
        store.write_labels_files({asset: restored.text})
    change.write_after()
    return True


def _restore_selections(store: Store, asset: str, undone: Sequence[StepSelections]) -> None:
    for step in undone:
        selections.restore_selections(store, asset, step.changes, step.successors)


def restore_labels_text(now: LabelsText, undone: Sequence[StepSelections]) -> LabelsText | None:
    """What a labels file said before steps, the last one first; None where it was changed since, or for no steps."""
    text = now.text
    for step in undone:
        if text not in (step.labels_before, *step.labels_between, step.labels_after):
            return None
        text = step.labels_before
    return LabelsText(text) if undone else None


def find_labels_before(
    store: Store, asset: str, undone: Sequence[StepSelections], mesh: symbolic.SymbolicMesh
) -> tuple[dict[str, symbolic.Label | None], list[str]]:
    """The labels that hulls had before they were split, unless those of their parts were changed since; notes on
    these."""
    now: dict[str, symbolic.Label | None] = dict(store.labels(asset).labels)
    notes, found = list[str](), dict[str, symbolic.Label | None]()
    for step in undone:
        were, became = (symbolic.parse_labels_text(text).labels for text in (step.labels_before, step.labels_after))
        for hull, parts in step.parts.items():
            if all(now.get(part) == became.get(part) for part in parts):
                now[hull] = found[hull] = were.get(hull)
            else:
                now[hull] = None
                notes.append(f"{hull} gets its label from its parts, which were labelled since it was split")
    return {name: label for name, label in found.items() if name in mesh.index}, notes


def confirm_selections(store: Store, asset: str) -> None:
    """Note that a person has looked at what was carried to the parts of split hulls of an asset."""
    with store.lock():
        steps = read_journal(store, asset)
        if any(not change.looked for step in steps for change in step.changes):
            seen = [
                step.model_copy(update={"changes": tuple(c.model_copy(update={"looked": True}) for c in step.changes)})
                for step in steps
            ]
            write_journal(store, asset, seen)


def describe_carried(store: Store, asset: str, steps: int) -> Iterator[str]:
    """A sentence for each selection that was carried to parts of a hull and that no person has looked at since.

    steps: how many the preparation has; a sentence more where what was done beyond them was cut short. Raises
    ProjectError where a file cannot be read.
    """
    journal = read_journal(store, asset)
    for step in (one for one in journal if one.place < steps):
        for change in (one for one in step.changes if not one.looked):
            yield from selections.describe_change(store, asset, change, step.parts)
    if any(step.place >= steps for step in journal):
        command = f"meshforge prepare {store.folder} {asset} --undo"
        yield f"its preparation was cut short, and selections may name hulls that are not there. Finish with: {command}"
