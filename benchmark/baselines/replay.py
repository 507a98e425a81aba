"""The demonstrations of a session, replayed for a model to look at."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.study import CONDITIONS, Bench, Desk, Session
from benchmark.study.person import Person
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, begin_replay


@dataclass(frozen=True, eq=False)
class Replay:
    """A demonstration. stages: the mesh before its steps, and after each, in the frame that the rules reason in."""

    name: str
    demo: Demonstration
    stages: tuple[SymbolicMesh, ...]

    @property
    def before(self) -> SymbolicMesh:
        return self.stages[0]

    @property
    def after(self) -> SymbolicMesh:
        return self.stages[-1]

    def find_products(self, rule: int) -> tuple[str, ...]:
        """The hulls that a step made, by its number."""
        old, new = self.stages[rule - 1 : rule + 1]
        return tuple(name for name in new.index if name not in old.index)


def desk_of(bench: Bench, session: Session) -> Desk:
    """The meshes as the person of a session got them."""
    labels = CONDITIONS[session.condition].labels
    assert labels != "propagated", "these labels changed on the way"
    return bench.desk(labels, session.seed)


def replay_demonstrations(bench: Bench, session: Session) -> list[Replay]:
    """What the person of a session showed, mesh by mesh, all steps of each."""
    desk = desk_of(bench, session)
    person = Person(desk, session.seed, CONDITIONS[session.condition])
    return [_replay(bench, desk, person, name) for name in dict.fromkeys(session.shown)]


def _replay(bench: Bench, desk: Desk, person: Person, name: str) -> Replay:
    frame = bench.task.program
    try:
        demo = person.shows(desk, name)
        replay = begin_replay(name, demo, frame.orient, frame.contact)
    except MeshForgeError:  # a landmark is labelled wrongly: the person put that right, to be able to show anything
        demo = person.shows(_landmarks_right(bench, desk, name), name)
        replay = begin_replay(name, demo, frame.orient, frame.contact)
    stages = [replay.mesh]
    for rule in frame.rules:
        replay = replay.advance(rule, bench.task.templates, frame.extremity)
        stages.append(replay.mesh)
    return Replay(name, demo, tuple(stages))


def _landmarks_right(bench: Bench, desk: Desk, name: str) -> Desk:
    landmarks = Program(orient=bench.task.program.orient).labels_in_use
    true = bench.truth.meshes[name].labels
    right = {hull: label for hull, label in true.items() if label.name in landmarks}
    return Desk(bench, {name: desk.meshes[name].with_labels(right)})
