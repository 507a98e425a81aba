"""The tool's side of a review: what it learns, how it judges a family, what it makes of a reply."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from benchmark.study.condition import Condition
from benchmark.study.desk import Bench, Desk, Selections
from meshforge.language import Program
from meshforge.signoff import (
    Assessment,
    ReviewQuestion,
    ReviewReply,
    ReviewState,
    apply_reply,
    describe_odd_results,
    list_answers,
    review_family,
)
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration, LearningOutcome


class Tool:
    """As a person meets it, who reviews a task's family under a condition."""

    def __init__(self, bench: Bench, condition: Condition) -> None:
        self._family, self._options = bench.relatives, condition.options

    def begin(
        self,
        desk: Desk,
        demos: Mapping[str, Demonstration] | None = None,
        answers: Sequence[Answer] = (),
        accepted: Mapping[str, Selections] | None = None,
    ) -> ReviewState:
        """What is known of a family at the start: what was shown, answered and accepted before there was a queue."""
        frame = replace(desk.bench.task.program, rules=())
        return ReviewState(
            desk.meshes, frame, desk.bench.task.templates, demos or {}, tuple(answers), dict(accepted or {})
        )

    def take_labels(self, desk: Desk) -> Desk:
        """The meshes with the labels that all that is known of the family speaks for; a person's stay."""
        said = [hull.annotation for mesh in desk.meshes.values() for hull in mesh.hulls]
        agreed = iter(self._family.infer(said).agree(said))
        meshes = dict(desk.meshes)
        for name, mesh in desk.meshes.items():
            found = {hull.name: next(agreed) for hull in mesh.hulls}
            if any(found[hull.name] != hull.annotation for hull in mesh.hulls):
                meshes[name] = mesh.with_labels(found)
        return desk.with_meshes(meshes)

    def learn(self, desk: Desk, state: ReviewState) -> LearningOutcome | None:
        """What it learns from all that it was told, None before anything was shown; raises as `synthesize` does."""
        if not state.demos:
            return None
        demos = [Demonstration(desk.meshes[name], demo.steps, name) for name, demo in state.demos.items()]
        said = [hull.annotation for mesh in desk.meshes.values() for hull in mesh.hulls]
        answers = list_answers(state, self._family.infer(said))
        return desk.learn(demos, self._options, None, list(answers))

    def review(self, desk: Desk, state: ReviewState, outcome: LearningOutcome | None) -> Assessment:
        """How the family stands, and what it asks next."""
        return review_family(state, outcome, self._family, alarms=self.find_alarms(desk, outcome))

    def find_alarms(self, desk: Desk, outcome: LearningOutcome | None) -> dict[str, tuple[str, ...]]:
        """Sentences on the edits that stand out, by asset."""
        program = program_of(outcome)
        if program is None:
            return {}
        edits = {name: desk.bench.measure(name, desk.edit(program, name)) for name in desk.meshes}
        return describe_odd_results({name: one for name, one in edits.items() if one is not None})

    def apply(
        self, state: ReviewState, question: ReviewQuestion, reply: ReviewReply, done: Selections | None = None
    ) -> ReviewState:
        """What is known after a reply; done: what the rules select on the asset whose result was asked about."""
        return apply_reply(state, question, reply, done)


def show(state: ReviewState, name: str, demo: Demonstration, meshes: Mapping[str, SymbolicMesh]) -> ReviewState:
    """What is known once an asset was demonstrated; what was accepted or asked about it before is void."""
    accepted = {other: done for other, done in state.accepted.items() if other != name}
    mended = {other: done for other, done in state.mended.items() if other != name}
    return replace(state, meshes=meshes, demos={**state.demos, name: demo}, accepted=accepted, mended=mended)


def forget(state: ReviewState, name: str) -> ReviewState:
    """What is known when a demonstration was taken back, and its asset flagged: nothing fits it."""
    demos = {other: demo for other, demo in state.demos.items() if other != name}
    answers = tuple(answer for answer in state.answers if answer.asset != name)
    return replace(state, demos=demos, answers=answers, aside=state.aside | {name})


def program_of(outcome: LearningOutcome | None) -> Program | None:
    """The program that was learned, if any."""
    return outcome.program if outcome else None
