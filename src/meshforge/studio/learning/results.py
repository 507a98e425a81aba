"""Results of learning as the page shows them: the program, how sure the edits are, and what programs and extractors
select on each asset."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from meshforge import synthesis
from meshforge.batch import template_digests
from meshforge.common import MeshForgeError
from meshforge.language import EXTREMITY, Extractor, Program, Template, explain, parse_extractor, select_mask
from meshforge.signoff import Assessment, ReviewChoice, ReviewQuestion, ReviewState
from meshforge.studio.queries.programs import rule_views
from meshforge.studio.wire import family
from meshforge.studio.wire import program as wire
from meshforge.symbolic import SymbolicMesh


def build_outcome_view(number: int, outcome: synthesis.LearningOutcome, looked_at: int) -> wire.OutcomeView:
    """Return a learning run for the page. number: of the run; looked_at: how many assets it looked at."""
    failure = outcome if isinstance(outcome, synthesis.NoProgram) else None
    return wire.OutcomeView(
        number=number,
        status=outcome.status,
        program=str(outcome.program) if outcome.program else None,
        looked_at=looked_at,
        rules=rule_views(outcome.program or Program(rules=outcome.rules)),
        unambiguous=outcome.unambiguous,
        candidates=tuple(map(wire.CandidateView.model_validate, outcome.candidates)),
        repairs=len(outcome.repairs),
        nearest=wire.NearestView.model_validate(outcome.nearest) if outcome.nearest else None,
        why=failure.why if failure else None,
        advice=failure.advice if failure else (),
        stale=tuple(f"{answer.rule}:{answer.asset}" for answer in outcome.stale),
        overruled=outcome.overruled,
    )


def view_assessment(
    assessment: Assessment, state: ReviewState, has_program: bool = True, unseen: int = 0
) -> family.AssessmentView:
    """Return an assessment as the page shows it; without a program no edit has a probability. unseen: assets of the
    family that are not in it."""
    question = assessment.question
    asked = _view_question(question, state.meshes) if question else None
    if not has_program:
        return family.AssessmentView(threshold=assessment.threshold, question=asked)
    signed = set(assessment.signed_off)
    rows = tuple(
        family.ConfidenceView(
            asset=name,
            probability=round(one.confidence, 4),
            reasons=one.reasons,
            state="excluded" if name in assessment.excluded else "signed" if name in signed else "needs review",
            reviewed=name in assessment.looked_at,
        )
        for name, one in assessment.assets.items()
    )
    counts = {what: sum(row.state == what for row in rows) for what in ("signed", "needs review", "excluded")}
    return family.AssessmentView(
        threshold=assessment.threshold,
        signed_off=counts["signed"],
        need_review=counts["needs review"],
        excluded=counts["excluded"],
        unseen=unseen,
        assets=rows,
        question=asked,
    )


def _view_question(question: ReviewQuestion, meshes: Mapping[str, SymbolicMesh]) -> family.ReviewQuestionView:
    shown = question.to_json()
    shown["hulls"] = [{**one, "place": meshes[one["asset"]].index[one["hull"]]} for one in shown["hulls"]]
    shown["choices"] = [{**one.to_json(), "sentence": _explain_candidate(one)} for one in question.choices]
    return family.ReviewQuestionView(**shown)


def _explain_candidate(choice: ReviewChoice) -> str:
    if choice.select is None:
        return ""
    try:
        return explain(parse_extractor(choice.text))
    except MeshForgeError:
        return ""


@dataclass(frozen=True, eq=False)
class ProgramWithTemplates:
    """A program with the templates that it names."""

    program: Program
    templates: Mapping[str, Template]

    @cached_property
    def key(self) -> tuple[str, str]:
        """Two with the same key do the same on every asset."""
        return str(self.program), str(template_digests(self.templates))


class HullOrigins:
    """Which of an asset's own hulls each hull is, or was made of, while a program runs."""

    def __init__(self, mesh: SymbolicMesh) -> None:
        self._own: dict[str, frozenset[int]] = {name: frozenset({k}) for name, k in mesh.index.items()}

    def of(self, names: Iterable[str]) -> tuple[int, ...]:
        """Return positions of the asset's own hulls, sorted."""
        return tuple(sorted(frozenset[int]().union(*(self._own[name] for name in names))))

    def add(self, made: Sequence[str], sources: Sequence[Sequence[str]]) -> None:
        """Add hulls that were made; sources: of each of them, the names of the hulls that it was made of."""
        for name, parts in zip(made, sources, strict=True):
            self._own[name] = frozenset(self.of(parts))


def measure_reach(plan: ProgramWithTemplates, asset: str, mesh: SymbolicMesh) -> wire.Reach:
    """Return what a program does on an asset; cached with the mesh."""
    return synthesis.memoize(mesh, ("reach", asset, plan.key), wire.Reach, lambda: _measure_reach(plan, asset, mesh))


def _measure_reach(plan: ProgramWithTemplates, asset: str, mesh: SymbolicMesh) -> wire.Reach:
    try:
        run = plan.program.run(mesh, plan.templates, memo=synthesis.memoize)
    except MeshForgeError as error:
        return wire.Reach(asset=asset, error=error.message)
    origins, rules = HullOrigins(mesh), []
    for line in run.trace:
        rules.append(origins.of(line.selected))
        origins.add(line.made, line.sources)
    return wire.Reach(asset=asset, rules=tuple(rules))


def select_after(plan: ProgramWithTemplates, mesh: SymbolicMesh, extractor: Extractor) -> tuple[int, ...]:
    """Return positions of the asset's own hulls that an extractor selects after the rules of a plan, or that the hulls
    it selects were made of; empty where these rules cannot be done."""
    origins = HullOrigins(mesh)
    try:
        *_, last = plan.program.replay(mesh, plan.templates, memo=synthesis.memoize)
    except MeshForgeError:
        return ()
    for line in last.trace:
        origins.add(line.made, line.sources)
    return origins.of(last.mesh.names_of(select_mask(extractor, last.mesh, plan.program.extremity or EXTREMITY)))
