"""What a person does with a project who teaches a task, by the public methods of `Project`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.project import Project, suggest_first_demonstration
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, LearningOutcome, Options, Repair, Step


class TaskClient:
    """Whatever is done is written to the disk."""

    def __init__(self, project: Project) -> None:
        self.project = project if project.cache else project.with_cache()

    # What a person does

    def demonstrate(self, asset: str, steps: Iterable[Step]) -> None:
        """Show the edit on an asset."""
        self.project.demonstrate(asset, steps)

    def take_demonstration_back(self, asset: str) -> None:
        """Take the demonstration of an asset back, and what was answered about it."""
        self.project.demonstrate(asset, ())
        for answer in self.answers:
            if answer.asset == asset:
                self.take_answer_back(answer)

    def synthesize(self, options: Options, confirm: Callable[[Repair], bool] | None = None) -> LearningOutcome:
        """Learn from all that was shown and said; confirm: what the person says of repairs, which is kept."""
        return self.project.synthesize(options=options, confirm=confirm)

    def take_answer_back(self, answer: Answer) -> None:
        """Take an answer back."""
        self.project.take_back(f"{answer.rule}:{answer.asset}")

    def refuse_choices(self, answer: Answer) -> None:
        """Say in place of an answer that none of the choices was meant."""
        self.project.add_answer(Answer(answer.rule, answer.asset, None))

    def accept(self, asset: str) -> None:
        """Find the result of an asset right, once it is written."""
        for _ in self.project.apply([asset], execution=IN_PROCESS):
            pass
        self.project.set_verdict(asset, "accepted")

    def set_labels(self, asset: str, labels: Mapping[str, str]) -> None:
        """Label hulls by hand."""
        self.project.set_labels(asset, labels)

    def propagate_labels(self) -> str | None:
        """Propagate labels to the assets that nobody labelled; the asset to label next, None where all are.

        Where no label is given yet, that asset is all that the product tells.
        """
        try:
            return self.project.label("propagate").next
        except ProjectError as refusal:
            told = refusal.remedy or ""
            return next((asset for asset in self.project.assets() if f"best {asset}." in told), None)

    def take_labels(self) -> None:
        """Take the labels that all sources together speak for, where any hull has one."""
        if self.project.vocabulary and any(mesh.labels for mesh in self.read_meshes().values()):
            self.project.label("propagate")

    # What a person sees

    def propose_first(self, assets: Sequence[str]) -> str | None:
        """The one of some assets that the product proposes to demonstrate first."""
        return suggest_first_demonstration(self.project, assets)

    @property
    def answers(self) -> tuple[Answer, ...]:
        """What was answered so far."""
        return tuple(line.answer for line in self.project.feedback().answers.values())

    def read_meshes(self) -> dict[str, SymbolicMesh]:
        """All assets with their labels; those whose labels stay are the same objects."""
        return dict(self.project.meshes_by_id())
