"""What a person does besides who signs the family of a project off: reviews, replies, looks at what is written."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from benchmark.signoff.judge import Output
from benchmark.study.client import TaskClient
from benchmark.tasks import EditResult
from meshforge.batch import IN_PROCESS
from meshforge.common import MeshForgeError
from meshforge.language import Program
from meshforge.project import Project, ProjectReview, run_with_manual_edits
from meshforge.signoff import Assessment, ReviewQuestion, ReviewReply
from meshforge.synthesis import Nearest, NoProgram


@dataclass(frozen=True, eq=False, slots=True)
class FamilyStatus:
    """How a family stands, as a person is told.

    question: the one that is asked; has_program: whether a program fits all that was shown and said; signed_off, held,
    excluded: ids of assets; probabilities: by id, as far as they are told; nearest: what came nearest if nothing fits.
    """

    question: ReviewQuestion | None
    has_program: bool
    signed_off: Collection[str]
    held: Collection[str]
    excluded: Collection[str]
    probabilities: Mapping[str, float] = field(default_factory=dict)
    nearest: Nearest | None = None


class Client(TaskClient):
    """By the public methods of `Project`. found: by the last look; program: of the project then."""

    name = "Project"
    says_what_is_right = True
    """Whether the person says of a wrong result which hulls or labels are right, or no more than that it is wrong."""
    shows_corrections = True
    """Whether they show the whole edit of a result that is wrong for another reason."""

    def __init__(self, project: Project) -> None:
        super().__init__(project)
        self.program = project.program()
        self.found: ProjectReview | None = None
        self._outputs = dict[tuple[str, str, str, str], Output]()

    # What a person does

    def review(self) -> FamilyStatus:
        """Look how the family stands. Raises MeshForgeError where the product refuses what was shown."""
        try:
            self.found = found = self.project.review(execution=IN_PROCESS)
        finally:
            self.program = self.project.program()
        outcome = found.outcome
        nearest = outcome.nearest if isinstance(outcome, NoProgram) else None
        return _build_status(found.assessment, outcome is not None and outcome.program is not None, nearest)

    def reply(self, question: ReviewQuestion, reply: ReviewReply) -> None:
        """Reply to the question that the last look asked."""
        self.project.reply(question, reply)

    def set_labels(self, asset: str, labels: Mapping[str, str]) -> None:
        """Label hulls by hand, then let the product weigh all labels again."""
        super().set_labels(asset, labels)
        self.take_labels()

    # What a person sees

    def read_output(self, asset: str) -> Output | None:
        """What the project would write of an asset: by its program, then by hand; None while there is no program."""
        program, project = self.program, self.project
        if program is None:
            return None
        by_hand, meant = project.manual_edits(asset), project.feedback().verdict_on(asset)
        key = (asset, str(program), str(project.labels_and_classes(asset)), f"{by_hand} {meant and meant.meant}")
        if key not in self._outputs:
            self._outputs[key] = Output(self._edit(asset, program), bool(by_hand))
        return self._outputs[key]

    def _edit(self, asset: str, program: Program) -> EditResult:
        try:
            done = run_with_manual_edits(self.project, asset, self.read_meshes()[asset], program)
        except MeshForgeError as error:
            return EditResult(None, error=str(error))
        rules = zip(program.rules, done.run.trace, strict=True)
        named = {name for rule, line in rules if rule.label for name in line.made}
        if any(one.label for one in done.manual_edits):
            named |= done.mesh.index.keys() - done.run.mesh.index.keys()
        return EditResult(done.mesh, done.run.trace, frozenset(named))


def _build_status(found: Assessment, has_program: bool, nearest: Nearest | None) -> FamilyStatus:
    shares = {name: one.confidence for name, one in found.assets.items()}
    return FamilyStatus(
        found.question, has_program, found.signed_off, found.need_review, found.excluded, shares, nearest
    )
