"""A project as people use it: a `Store` whose further methods are the use cases, one statement each."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path

from meshforge import synthesis
from meshforge.batch import (
    APPLY_DEFAULTS,
    EXECUTION_DEFAULTS,
    ApplyOptions,
    AssetJob,
    AssetOutcome,
    ExecutionOptions,
    apply,
    cut_hull,
)
from meshforge.geometry import CoacdSettings, DecomposeSettings
from meshforge.labels import LabelStore
from meshforge.language import Action, Orient, Program, Template
from meshforge.project.answer import (
    add_answer,
    answer_by_choice,
    confirm_repair,
    reject_repair,
    take_back,
    take_back_all,
)
from meshforge.project.demonstrate import delete_rule, demonstrate, move_rule
from meshforge.project.learn import LearnOptions, ProgramState, learn_program, read_program_state
from meshforge.project.overview import compute_status
from meshforge.project.prepare import (
    DecomposeOptions,
    PreparationResult,
    change_preparation,
    decompose,
    split,
    unprepare,
)
from meshforge.project.rename_label import rename_label
from meshforge.project.review import review_assets
from meshforge.project.run import build_work, correct, mesh_before_rule
from meshforge.project.status import AssetStatus, Status
from meshforge.store import Verdict, add_assets, create_folder, find_assets
from meshforge.symbolic import SymbolicMesh


@dataclass(frozen=True)
class Project(LabelStore):
    """A project folder, with everything that is done with it. It is a `Store`: what is set is written at once."""

    # Opening

    @staticmethod
    def create(
        folder: str | Path,
        assets: Sequence[str | Path],
        *,
        name: str | None = None,
        vocabulary: Sequence[str] = (),
        orient: Orient | str | None = None,
    ) -> Project:
        """Make a project folder for some assets, given as files, folders and globs.

        Raises ProjectError where there is a project already, UsageError where an argument matches nothing.
        """
        return Project.open(create_folder(folder, assets, name, vocabulary, orient))

    @staticmethod
    def open(folder: str | Path) -> Project:
        """The project in a folder. Raises ProjectError: none there, its settings do not fit, or an asset is gone."""
        folder = Path(folder).absolute()
        return Project(folder, find_assets(folder))

    def rename_label(self, old: str, new: str) -> None:
        """Give a label of the vocabulary another name, wherever the project says it.

        Raises ProjectError: no such label, the new one is there already, or no program could write it.
        """
        rename_label(self, old, new)

    def add_assets(self, paths: Iterable[str | Path]) -> Project:
        """The project with more assets: files below the folder that ids count from. Raises ProjectError for others."""
        with self.lock():
            add_assets(self.folder, self.found, paths)
        return Project.open(self.folder)

    # Preparation

    def decompose(
        self,
        assets: Iterable[str] | None = None,
        settings: DecomposeSettings | None = None,
        *,
        only: Sequence[str] = (),
        again: bool = False,
        hollow: bool = False,
        execution: ExecutionOptions = EXECUTION_DEFAULTS,
        write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
    ) -> Iterator[PreparationResult]:
        """Make hulls of what has none: non-convex pieces, and what bodies without collision geometry show.

        assets: all when None; settings: CoACD's defaults when None; only: names of pieces and bodies, or patterns;
        again: also what is decomposed already; hollow: shells of one sheet are not filled; write_block: the block in
        which an asset's files are written. What is done stays done when the caller stops in the midst.
        """
        ids = self.assets() if assets is None else tuple(dict.fromkeys(assets))
        options = DecomposeOptions(settings or CoacdSettings(), tuple(only), again, hollow)
        return decompose(self, ids, options, execution, write_block)

    def cut(self, asset: str, hull: str, at: Sequence[float], across: Sequence[float]) -> PreparationResult:
        """Cut a hull along the plane through `at` (3,) [m] across `across` (3,), in the frame that the asset comes in.

        Raises GeometryError: no such hull, or a plane that misses it.
        """
        return change_preparation(self, asset, lambda source, before: cut_hull(source, before, hull, at, across))

    def split(
        self, asset: str, hull: str, settings: DecomposeSettings | None = None, *, hollow: bool = False
    ) -> PreparationResult:
        """Split a hull by a decomposition of what its body shows, or of the opaque piece that it was made of.

        Raises GeometryError: no such hull, nothing to decompose, or nothing that divides it.
        """
        return split(self, asset, hull, settings or CoacdSettings(), hollow)

    def unprepare(self, asset: str, *, everything: bool = False) -> PreparationResult:
        """Take back the last thing that was done to an asset before the program, or everything.

        Everything also of an asset that is gone or cannot be read. Raises ProjectError where nothing was done.
        """
        return unprepare(self, asset, everything)

    # Demonstrations

    def demonstrate(self, asset: str, steps: Iterable[synthesis.Step]) -> None:
        """Set the steps that are demonstrated on an asset; no steps take the demonstration away."""
        demonstrate(self, asset, tuple(steps))

    def move_rule(self, rule: int, to: int) -> None:
        """Put a rule at another place in all demonstrations and answers. Raises UsageError for a wrong number."""
        move_rule(self, rule, to)

    def delete_rule(self, rule: int) -> None:
        """Take a rule out of all demonstrations, and the answers about it. Raises UsageError for a wrong number."""
        delete_rule(self, rule)

    # The program

    def accept(self, program: Program) -> None:
        """Make it the project's program."""
        self.write_program(program)

    def program_state(self) -> ProgramState:
        """How the program stands to what it was learned from, and whether a person wrote it."""
        return read_program_state(self)

    def synthesize(
        self,
        *,
        accept: bool = True,
        options: synthesis.Options | None = None,
        confirm: Callable[[synthesis.Repair], bool] | None = None,
        stop: Callable[[], bool] | None = None,
        answers: Sequence[synthesis.Answer] = (),
        meshes: Mapping[str, SymbolicMesh] | None = None,
    ) -> synthesis.LearningOutcome:
        """Learn the program from the demonstrations and from what a person said since.

        accept: what is found becomes the project's program, and what `confirm` says about repairs is kept at once.
        confirm, stop: as of `meshforge.synthesize`; answers: for this lesson, before those that are kept.
        meshes: the assets by id, where they are in memory already (`Family`); else they are read, of very many some.
        """
        how = LearnOptions(accept=accept, options=options, confirm=confirm, stop=stop, answers=answers, meshes=meshes)
        return learn_program(self, how)

    def mesh_before_rule(
        self, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
    ) -> SymbolicMesh:
        """An asset as a rule of a program meets it: turned, and edited by the rules before."""
        return mesh_before_rule(self, asset, rule, program, meshes)

    # What a person said while it was learned

    def answer(self, question: synthesis.Question, choice: int | None) -> str:
        """Answer a question by a choice, counted from 0, or by None for neither; give the answer's id `RULE:ASSET`."""
        return self.add_answer(answer_by_choice(question, choice))

    def add_answer(self, answer: synthesis.Answer) -> str:
        """The same for any selection, whether it was asked for or not. Raises ProjectError: no such asset or rule."""
        return add_answer(self, answer)

    def confirm(self, right: synthesis.LabelCorrection) -> str:
        """Repair a label, as a `Repair` proposes it or not; give the repair's id `ASSET#HULL=LABEL`.

        Raises ProjectError where the asset, the hull or the label is not there, or the hull has another label by now.
        """
        return confirm_repair(self, right)

    def reject(self, wrong: synthesis.LabelCorrection) -> str:
        """Refuse a repair, so that it is not proposed again; give its id."""
        return reject_repair(self, wrong)

    def take_back(self, said: str) -> str | None:
        """Take back an answer or a repair by its id; the hull of a confirmed repair gets the label it had before.

        Gives a sentence where that label was changed since, and is left alone. Raises ProjectError for an unknown id.
        """
        return take_back(self, said)

    def forget_answers(self) -> tuple[str, ...]:
        """Take back everything; gives the sentences about labels that are left alone."""
        return take_back_all(self)

    def apply(
        self,
        only: Collection[str] | None = None,
        *,
        out: Path | None = None,
        options: ApplyOptions = APPLY_DEFAULTS,
        execution: ExecutionOptions = EXECUTION_DEFAULTS,
    ) -> Iterator[AssetOutcome]:
        """Run the program on all assets or those of some ids, into `edited/` or `out`, as `meshforge.batch.apply` does.

        Raises ProjectError for an asset that is not there, and what `meshforge.batch.apply` raises.
        """
        program, work, templates = build_work(self, only)
        out = out or self.layout.edited
        return apply(program, work, out, templates=templates, options=options, execution=execution)

    def work(self) -> tuple[Program, tuple[AssetJob, ...], Mapping[str, Template]]:
        """What `apply` runs: the program, a job for each asset, and the templates. Raises ProjectError: no program."""
        return build_work(self, None)

    # After the program

    def correct(self, asset: str, select: Iterable[str], action: Action, label: str | None = None) -> None:
        """Add an edit by hand on hulls of an asset, by the names they have after the program and the edits before."""
        correct(self, asset, sorted(set(select)), action, label)

    def review(self, assets: str | Iterable[str], verdict: Verdict | None, note: str | None = None) -> None:
        """Accept or flag the output of one or several assets, or take that back by None; it counts until that changes.

        One that is accepted by itself was looked at: learning keeps to what the program selected there.
        Raises ProjectError, with nothing written, where there is no output that a verdict could be about.
        """
        review_assets(self, [assets] if isinstance(assets, str) else assets, verdict, note)

    def status(
        self,
        only: Collection[str] | None = None,
        *,
        others: Iterable[AssetStatus] = (),
        workers: int | None = None,
        progress: Callable[[], None] | None = None,
        stop: Callable[[], bool] | None = None,
    ) -> Status:
        """How far everything is, what is stale, and the next sensible step.

        only: ids; then the status holds these assets alone, and its next step counts besides them `others`, which are
        known already. workers, progress, stop: as of `meshforge.batch.run_isolated`, for assets that have to be read.
        """
        return compute_status(self, only, others, workers, progress, stop)
