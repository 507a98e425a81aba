"""A rule that was learned, what is told of it, and the proof that rules do on every demonstration what was shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from meshforge.common import MeshForgeError
from meshforge.language import Program, Rule, Template
from meshforge.synthesis import outcome
from meshforge.synthesis.candidates.rank import RankedCandidates
from meshforge.synthesis.demonstration import Demonstration, name_demonstrations
from meshforge.synthesis.search.smallest import NearestExtractor
from meshforge.synthesis.task import memoize


@dataclass(frozen=True, slots=True)
class RuleOutcome:
    """One rule, its readings, and the names of the meshes in their field."""

    rule: Rule
    candidates: RankedCandidates
    names: tuple[str, ...]

    @property
    def size(self) -> int:
        """Nodes of the extractor."""
        return self.candidates.terms[0].size

    def select(self) -> dict[str, frozenset[str]]:
        """Return the names of the hulls that the rule selects on each mesh of the field."""
        field, bits = self.candidates.field, self.candidates.terms[0].bits
        rows = zip(self.names, field.meshes, strict=True)
        return {name: frozenset(mesh.names_of(field.on(bits, place))) for place, (name, mesh) in enumerate(rows)}


def list_candidates(rule: int, ranked: RankedCandidates, names: Sequence[str]) -> Iterator[outcome.CandidateProgram]:
    """Yield the readings of a rule, the most believable first; names: of the meshes of their field."""
    for place, (term, belief) in enumerate(zip(ranked.terms, ranked.beliefs, strict=True)):
        differs = tuple(names[k] for k in ranked.differences(place))
        yield outcome.CandidateProgram(outcome.candidate_id(rule, place), rule, term.extractor, belief, differs)


def to_nearest(rule: int, miss: NearestExtractor) -> outcome.Nearest:
    """Return what came nearest, as callers read it."""
    return outcome.Nearest(rule, miss.extractor, miss.asset, miss.extra, miss.missing)


def verify(program: Program, demos: Sequence[Demonstration], templates: Mapping[str, Template]) -> None:
    """Raise AssertionError, an error of ours, where the program selects something else than was shown.

    Raises ProgramError where it cannot run: it asks for labels, and a demonstrated mesh has none.
    """
    made_of = tuple(templates[name].digest for name in program.templates if name in templates)
    for name, demo in name_demonstrations(demos):
        key = ("verified", str(program), made_of, demo.steps)
        memoize(demo.mesh, key, bool, partial(_check_demonstration, program, demo, templates, name))


def _check_demonstration(program: Program, demo: Demonstration, templates: Mapping[str, Template], name: str) -> bool:
    try:
        trace = program.run(demo.mesh, templates, memo=memoize).trace
    except MeshForgeError as error:
        raise error.at(name) from None
    for done in trace:
        step = demo.step(done.rule)
        if step and step.select != frozenset(done.selected):
            raise AssertionError(
                f"the learned rule {done.rule} selects {sorted(done.selected)} on {name}, "
                f"not {sorted(step.select or ())} as was shown"
            )
    return True
