"""All that a program is learned from, and its demonstrations replayed: the mesh as each rule meets it."""

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar
from weakref import WeakKeyDictionary

from meshforge import language
from meshforge.common import DemonstrationError, MeshForgeError
from meshforge.language import Replay
from meshforge.symbolic import Label, SymbolicMesh, mask_of, split_by_contact
from meshforge.synthesis.candidates.belief import NEITHER
from meshforge.synthesis.candidates.rank import Preference
from meshforge.synthesis.demonstration import (
    Answer,
    Demonstration,
    Example,
    LabelFix,
    RuleSpec,
    Step,
    name_demonstrations,
)
from meshforge.synthesis.options import Options

Family = Mapping[str, SymbolicMesh]
"""Meshes by the names that questions and readings call them."""


@dataclass(frozen=True, slots=True)
class LearningTask:
    """Demonstrations, the batch they stand for, and what a person said since.

    frame: the program without its rules; rejected: corrections of labels not to propose; confirmed: those that were
    made, as a person said that they are right.
    """

    rules: tuple[RuleSpec, ...]
    demos: tuple[Demonstration, ...]
    batch: Family
    frame: language.Program
    templates: Mapping[str, language.Template]
    answers: tuple[Answer, ...]
    rejected: frozenset[LabelFix]
    options: Options
    confirmed: tuple[LabelFix, ...] = ()


def name_family(batch: Iterable[SymbolicMesh] | Family, demos: Sequence[Demonstration]) -> dict[str, SymbolicMesh]:
    """Return the meshes of a batch in the order of their names, without those that are demonstrated.

    By default the name is the file's path.
    """
    shown, meshes = dict(name_demonstrations(demos)), {id(demo.mesh) for demo in demos}
    if not isinstance(batch, Mapping):
        batch = {str(one.asset.path) if one.asset else f"mesh {number}": one for number, one in enumerate(batch, 1)}
    rows = batch
    return {name: rows[name] for name in sorted(rows) if name not in shown and id(rows[name]) not in meshes}


def apply_fixes(mesh: SymbolicMesh, name: str, fixes: Iterable[LabelFix]) -> SymbolicMesh:
    """Return a mesh with the labels that corrections give to its hulls, as far as they are there."""
    given: dict[str, Label | None] = {c.hull: Label(c.to, 1.0, "repair") for c in fixes if c.asset == name}
    return mesh.with_labels(given) if given else mesh


def correct_demonstrations(demos: Sequence[Demonstration], fixes: Sequence[LabelFix]) -> tuple[Demonstration, ...]:
    """Return demonstrations with their names, on meshes with corrected labels."""
    rows = name_demonstrations(demos)
    return tuple(Demonstration(apply_fixes(demo.mesh, name, fixes), demo.steps, name) for name, demo in rows)


class ReplaySet:
    """All meshes as the next rule meets them.

    Those of the batch that have no labels at all, that cannot be oriented or that an action fails on, leave it: the
    program would fail there.
    """

    def __init__(self, task: LearningTask) -> None:
        batch, frame = task.batch, task.frame
        self._frame, self._templates = frame, task.templates
        self._answers = [answer for answer in task.answers if answer.price is None]
        self._unsure = [answer for answer in task.answers if answer.price is not None]
        self._demos = dict(name_demonstrations(task.demos))
        self.shown = [begin_replay(name, demo, frame.orient, frame.contact) for name, demo in self._demos.items()]
        bare = {
            name for name, mesh in batch.items() if frame.labels and not any(hull.annotation for hull in mesh.hulls)
        }
        rows = ((name, mesh) for name, mesh in batch.items() if name not in bare)
        self.others = [replay for name, mesh in rows if (replay := self._begin(name, mesh))]
        rules = range(1, 1 + max((len(demo.steps) for demo in task.demos), default=0))
        self._stale = self._answers_without_asset(self._answers)
        self._stale += [answer for answer in self._answers if answer.rule not in rules]

    @property
    def stale(self) -> tuple[Answer, ...]:
        """Answers whose rule, asset or hulls are not there."""
        return tuple(dict.fromkeys(self._stale))

    def _answers_without_asset(self, answers: Iterable[Answer]) -> list[Answer]:
        names = {replay.name for replay in [*self.shown, *self.others]}
        return [answer for answer in answers if answer.asset not in names]

    def _begin(self, name: str, mesh: SymbolicMesh) -> Replay | None:
        try:
            return Replay.begin(mesh, self._frame.orient, self._frame.contact, name=name, memo=memoize)
        except MeshForgeError:
            return None

    def examples(self, rule: RuleSpec) -> tuple[list[Example], list[Replay]]:
        """Return what is known about a rule, by demonstrations and answers, and the meshes about which nothing is."""
        examples, open_ = [], []
        answered = {a.asset: a for a in self._answers if a.rule == rule.number}  # the last one counts
        for replay in [*self.shown, *self.others]:
            shown = example_of(replay, self._demos.get(replay.name), rule)
            answer = answered.get(replay.name)
            if shown is None and answer and answer.select is not None:
                shown = _example_of_answer(replay, answer)
                self._stale += [] if shown else [answer]
            if shown:
                examples.append(shown)
            else:
                open_.append(replay)
        self._stale += self._answers_without_asset(answered.values())
        return examples, open_

    def assets_with_answers(self, rule: int) -> tuple[str, ...]:
        """Return the meshes of which an answer, and no demonstration, says what the rule selects."""
        silent = {replay.name for replay in [*self.shown, *self.others] if rule not in replay.selections}
        selections = {a.asset: a.select for a in self._answers if a.rule == rule}
        return tuple(name for name, select in selections.items() if select is not None and name in silent)

    def preferences(self, rule: int, meshes: Sequence[SymbolicMesh]) -> list[Preference]:
        """Return what a person said is not meant, or is probably meant."""
        places = {id(mesh): place for place, mesh in enumerate(meshes)}
        by_name = {replay.name: replay.mesh for replay in [*self.shown, *self.others] if id(replay.mesh) in places}
        last = {a.asset: a for a in self._answers if a.rule == rule}.values()
        return [
            Preference(places[id(mesh)], mask_of(map(mesh.index.__getitem__, names)), price, is_meant)
            for answer in [*last, *(one for one in self._unsure if one.rule == rule)]
            if (mesh := by_name.get(answer.asset))
            for price in [NEITHER if answer.price is None else answer.price]
            for names, is_meant in _list_preferred(answer)
            if names <= mesh.index.keys()
        ]

    def advance(self, rule: language.Rule, last: bool) -> None:
        """Run a rule on all meshes; the last one only on those that are demonstrated."""
        delta = self._frame.extremity
        self.shown = [replay.advance(rule, self._templates, delta) for replay in self.shown]
        if not last:
            self.others = [done for replay in self.others if (done := self._advance(replay, rule))]

    def _advance(self, replay: Replay, rule: language.Rule) -> Replay | None:
        try:
            return replay.advance(rule, self._templates, self._frame.extremity)
        except MeshForgeError:
            return None

    def correct(self, fixes: Sequence[LabelFix]) -> None:
        """Go on as if labels were corrected."""
        self.shown = [_correct_replay(replay, fixes) for replay in self.shown]
        self.others = [_correct_replay(replay, fixes) for replay in self.others]


def _list_preferred(answer: Answer) -> Iterator[tuple[frozenset[str], bool]]:
    """Selections that are not meant, or where the answer is unsure the one that probably is."""
    yield from ((names, False) for names in answer.refused)
    if answer.select is not None and answer.price is not None:
        yield answer.select, True


def _example_of_answer(replay: Replay, answer: Answer) -> Example | None:
    """None where a hull of the answer is not there: it was made by an earlier rule that is another one now."""
    index, names = replay.mesh.index, answer.select or frozenset()
    if not names <= index.keys():
        return None
    return Example(replay.name, replay.mesh, sum(1 << index[name] for name in names))


def _correct_replay(replay: Replay, fixes: Sequence[LabelFix]) -> Replay:
    mesh = apply_fixes(replay.mesh, replay.name, fixes)
    return replay if mesh is replay.mesh else replace(replay, mesh=mesh)


Value = TypeVar("Value")
_memo: WeakKeyDictionary[SymbolicMesh, dict[Hashable, object]] = WeakKeyDictionary()


def begin_replay(name: str, demo: Demonstration, orient: language.Orient | None, contact: float | None) -> Replay:
    """Return a demonstration before its first rule. Raises ProgramError where the orientation fails on its mesh."""
    return Replay.begin(demo.mesh, orient, contact, name=name, selections=demo.selections, memo=memoize)


def example_of(replay: Replay, demo: Demonstration | None, rule: RuleSpec) -> Example | None:
    """Return what a demonstration says about the next rule, None where it says nothing.

    Raises DemonstrationError for a hull that is not there, and where `Each` would do something else than was shown.
    """
    step = demo.step(rule.number) if demo else None
    if step is None:
        return None
    selection = replay.mask_of(step.select or ())
    if rule.each_in and step.shown and not isinstance(step.action, language.Each):
        _check_single(replay, step, rule, selection)
    return Example(replay.name, replay.mesh, selection)


def _check_single(replay: Replay, shown: Step, rule: RuleSpec, selection: int) -> None:
    parts = len(split_by_contact(replay.mesh, selection))
    if parts > 1:
        raise DemonstrationError(
            f"rule {rule.number} does {shown.action} in {replay.name} on {parts} parts that do not touch, "
            f"but {rule.action} in {rule.each_in}",
            remedy=f"Make it {rule.action} in {replay.name}, or {shown.action} in {rule.each_in}.",
        )


def memoize(mesh: SymbolicMesh, key: Hashable, kind: type[Value], make: Callable[[], Value]) -> Value:
    """Return what `make` gives for the mesh and the key, made once.

    It must not hold on to the mesh itself, which would then live for ever; errors are not remembered.
    """
    known = _memo.setdefault(mesh, {})
    found = known.get((kind, key))
    if isinstance(found, kind):
        return found
    made = make()
    known[kind, key] = made
    return made
