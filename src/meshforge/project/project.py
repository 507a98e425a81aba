"""A project as people use it: a `Store` whose further methods are the use cases, one statement each."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import (
    APPLY_DEFAULTS,
    EXECUTION_DEFAULTS,
    IN_PROCESS,
    TIMEOUT,
    ApplyOptions,
    AssetJob,
    AssetOutcome,
    AssetSet,
    Correction,
    ExecutionOptions,
    Preparation,
    apply,
    cut_hull,
    hold_lock,
    load_named_templates,
    read_preparation,
)
from meshforge.geometry import CoacdSettings, DecomposeSettings
from meshforge.labels import (
    LabelFileOptions,
    LabelOffers,
    LabelOutcome,
    OfferCache,
    OutcomeCallback,
    PatternPairs,
    PropagationResult,
    Proposals,
    Stage,
    Tally,
    VlmForecast,
    VlmResult,
    ignore_report,
    ignore_stage,
    merge,
    progress,
)
from meshforge.labels import progress as progress_module
from meshforge.labels.from_files import label_by_files
from meshforge.labels.names import label_by_names
from meshforge.labels.propagation import label_by_propagation
from meshforge.labels.vlm import label_by_vlm as vlm_forecast
from meshforge.labels.vlm import label_by_vlm as vlm_labelling
from meshforge.language import Action, Orient, Program, Template
from meshforge.project import accept as accept_module
from meshforge.project import answer as answer_module
from meshforge.project import demonstrate as demonstrate_module
from meshforge.project import learn, overview, prepare, run
from meshforge.project import rename_label as rename_label_module
from meshforge.project import review as review_module
from meshforge.project.accept import ProgramState
from meshforge.project.prepare import PreparationResult
from meshforge.project.status import AssetStatus, Status
from meshforge.store import (
    AnswersFile,
    Layout,
    Review,
    Settings,
    Verdict,
    VlmSettings,
    feedback,
    orientation,
    read_settings,
    set_orientation,
    set_vocabulary,
)
from meshforge.store import folder as folder_module
from meshforge.store import meshes as meshes_module
from meshforge.store import program as program_module
from meshforge.store import steps as steps_module
from meshforge.symbolic import LabelFile, LabelSource, SymbolicMesh
from meshforge.synthesis import Answer, Demonstration, LabelCorrection, Options, Question, Repair, Step
from meshforge.synthesis import LearningOutcome as Lesson

if TYPE_CHECKING:
    from meshforge.labels import Usage


@dataclass(frozen=True)
class Project:
    """A project folder. Nothing but paths is held in memory: what is asked for is read, what is set is written.

    found: the assets, as they were when the project was opened.
    """

    folder: Path
    found: AssetSet = field(repr=False)

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
        return Project.open(folder_module.create_folder(folder, assets, name, vocabulary, orient))

    @staticmethod
    def open(folder: str | Path) -> Project:
        """The project in a folder. Raises ProjectError: none there, its settings do not fit, or an asset is gone."""
        folder = Path(folder).absolute()
        return Project(folder, folder_module.find_assets(folder))

    @property
    def layout(self) -> Layout:
        """Where everything lies."""
        return Layout(self.folder)

    def lock(self) -> AbstractContextManager[None]:
        """The project's lock, under which files are read, changed and written; a thread may take it again and again."""
        return hold_lock(self.layout.lock, str(self.folder), again=True)

    # Settings

    @property
    def settings(self) -> Settings:
        return read_settings(self.folder)

    @property
    def name(self) -> str:
        return self.settings.name

    @property
    def vocabulary(self) -> tuple[str, ...]:
        return self.settings.vocabulary

    @property
    def orientation(self) -> Orient | None:
        return orientation(self.settings, self.folder)

    def set_vocabulary(self, labels: Sequence[str]) -> None:
        """Set the labels that hulls can have. Raises ProgramError for one that no program could write."""
        set_vocabulary(self, labels)

    def rename_label(self, old: str, new: str) -> None:
        """Give a label of the vocabulary another name, wherever the project says it.

        Raises ProjectError: no such label, the new one is there already, or no program could write it.
        """
        rename_label_module.rename_label(self, old, new)

    def set_orientation(self, orient: Orient | str | None) -> None:
        """Set the orientation directive; a text has the form it has in a program."""
        set_orientation(self, orient)

    # Assets

    def assets(self) -> tuple[str, ...]:
        """The ids of all assets."""
        return tuple(self.found.ids)

    def path(self, asset: str) -> Path:
        """The file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
        return folder_module.path_of(self.folder, self.found, asset)

    def add_assets(self, paths: Iterable[str | Path]) -> Project:
        """The project with more assets: files below the folder that ids count from. Raises ProjectError for others."""
        folder_module.add_assets(self, paths)
        return Project.open(self.folder)

    def mesh(self, asset: str) -> SymbolicMesh:
        """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        return meshes_module.read_mesh(self, asset)

    def meshes(self) -> Iterator[SymbolicMesh]:
        """All assets with their labels, one after the other; those that cannot be read are left out."""
        return (mesh for _, mesh in self.meshes_by_id())

    def meshes_by_id(self, assets: Iterable[str] | None = None) -> Iterator[tuple[str, SymbolicMesh]]:
        """The same with their ids, of some assets only."""
        return meshes_module.read_named_meshes(self, self.assets() if assets is None else tuple(assets))

    def readers(self, assets: Iterable[str]) -> tuple[Callable[[], SymbolicMesh], ...]:
        """What reads each of some assets as `mesh` does, in this process or another."""
        return tuple(place.read_mesh for place in meshes_module.asset_files_of(self, assets))

    # Preparation

    def preparation(self, asset: str) -> Preparation:
        """What is done to an asset before the program. Raises AssetError where its files are damaged."""
        self.path(asset)
        return read_preparation(self.layout.preparation(asset)) or Preparation()

    def decompose(
        self,
        assets: Iterable[str] | None = None,
        settings: DecomposeSettings | None = None,
        *,
        only: Sequence[str] = (),
        again: bool = False,
        hollow: bool = False,
        workers: int | None = None,
        timeout: float | None = TIMEOUT,
        progress: Callable[[], None] | None = None,
        stop: Callable[[], bool] | None = None,
        keeping: Callable[[str], AbstractContextManager[object]] = nullcontext,
    ) -> Iterator[PreparationResult]:
        """Make hulls of what has none: opaque pieces, and what bodies without collision geometry show.

        assets: all when None; settings: CoACD's defaults when None; only: names of pieces and bodies, or patterns;
        again: anew, also where that is done; hollow: shells of one sheet are not filled. workers, timeout [s] for an
        asset, progress, stop: as of `meshforge.batch.apply`; keeping: gives what is entered while an asset's files are
        written. What is done stays done when the caller stops in the midst.
        """
        ids, how = self.assets() if assets is None else tuple(dict.fromkeys(assets)), settings or CoacdSettings()
        return prepare.decompose(
            self,
            ids,
            how,
            only=only,
            again=again,
            hollow=hollow,
            workers=workers,
            timeout=timeout,
            progress=progress,
            stop=stop,
            keeping=keeping,
        )

    def cut(self, asset: str, hull: str, at: Sequence[float], across: Sequence[float]) -> PreparationResult:
        """Cut a hull along the plane through `at` (3,) [m] across `across` (3,), in the frame that the asset comes in.

        Raises GeometryError: no such hull, or a plane that misses it.
        """
        return prepare.change_preparation(
            self, asset, lambda source, before: cut_hull(source, before, hull, at, across)
        )

    def split(
        self, asset: str, hull: str, settings: DecomposeSettings | None = None, *, hollow: bool = False
    ) -> PreparationResult:
        """Split a hull by a decomposition of what its body shows, or of the opaque piece that it was made of.

        Raises GeometryError: no such hull, nothing to decompose, or nothing that divides it.
        """
        return prepare.split(self, asset, hull, settings or CoacdSettings(), hollow)

    def unprepare(self, asset: str, *, everything: bool = False) -> PreparationResult:
        """Take back the last thing that was done to an asset before the program, or everything.

        Everything also of an asset that is gone or cannot be read. Raises ProjectError where nothing was done.
        """
        return prepare.unprepare(self, asset, everything)

    # Labels

    def labels(self, asset: str) -> LabelFile:
        """The labels of an asset as they are kept; empty where there are none."""
        return meshes_module.read_labels_file(self.layout.labels(asset))

    def set_labels(
        self, asset: str, labels: Mapping[str, str | None], *, source: LabelSource = "user", confidence: float = 1.0
    ) -> LabelOutcome:
        """Label some hulls of an asset, or take labels away by None. A machine's source never overwrites a person's."""
        return merge.set_labels(self, asset, labels, source, confidence)

    def label_from_files(
        self,
        source: Path | None = None,
        how: LabelFileOptions | None = None,
        *,
        spread: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Take over what files say: labels files, segmented points and meshes, and PartNet's semantics of links.

        source: a file for a single asset, a folder that mirrors the assets, or None for those beside them; how: the way
        they are read. A project without a vocabulary takes that of the files. spread: over worker processes, where one
        asset that crashes or hangs costs no more than itself; unless said, the work is done in this process. report:
        called with what became of each asset, as soon as its labels are written, in the order of the assets.
        """
        return label_by_files.label_from_files(self, source, how or LabelFileOptions(), spread, report)

    def propose_from_files(
        self,
        source: Path | None = None,
        how: LabelFileOptions | None = None,
        vocabulary: Sequence[str] | None = None,
        *,
        spread: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_files` would take, with nothing written; vocabulary: one to be tried."""
        return label_by_files.propose_from_files(self, source, how or LabelFileOptions(), vocabulary, spread)

    def label_offers(self) -> LabelOffers:
        """What `label_from_files` and `label_from_names` would give; see `OfferCache` for asking often."""
        return OfferCache().of(self)

    def label_from_names(
        self,
        meanings: PatternPairs = (),
        *,
        spread: ExecutionOptions = IN_PROCESS,
        report: OutcomeCallback = ignore_report,
    ) -> tuple[LabelOutcome, ...]:
        """Label hulls without a label by their own names, those of their bodies, and what else their files call them.

        By patterns first: `meanings`, then those of the project's settings; then by the words of the vocabulary, and
        words that are nearly those. spread, report: as of `label_from_files`.
        Raises ProjectError: no vocabulary; UsageError: a pattern that makes no sense.
        """
        return label_by_names.label_from_names(self, meanings, spread, report)

    def propose_from_names(
        self,
        meanings: PatternPairs = (),
        vocabulary: Sequence[str] | None = None,
        *,
        spread: ExecutionOptions = IN_PROCESS,
    ) -> Proposals:
        """What `label_from_names` would take, with nothing written; vocabulary: one to be tried."""
        return label_by_names.propose_from_names(self, meanings, vocabulary, spread)

    def plan_labels(self) -> str:
        """What there is to be labelled, in words: how many assets of what, and how many have labels by now."""
        return progress.describe_label_plan(self)

    def tally_labels(self, progress: Callable[[], None] | None = None) -> Tally:
        """How many hulls have which labels: from where, and how sure."""
        return progress_module.tally(self, progress)

    def draw_labels(
        self, folder: Path, assets: Sequence[str], progress: Callable[[], None] | None = None
    ) -> tuple[Path, ...]:
        """Write contact sheets of some assets, `labels-001.png` and so on, in which hulls have their labels' colours.

        Sheets of an earlier time are replaced. Raises UsageError where one cannot be written.
        """
        return progress_module.write_contact_sheets(self, folder, assets, progress)

    def propagate_labels(
        self,
        *,
        spread: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
        report: OutcomeCallback = ignore_report,
        keeping: label_by_propagation.WriteBlock = nullcontext,
    ) -> PropagationResult:
        """Carry the labels of a few assets to all others; what a person or a file says stays.

        How the hulls of an asset look is kept in the project, so that another time is quick. spread, report: as of
        `label_from_files`; stage: gives what is entered for each part of the work; keeping: the block in which all is
        written, given the asset that would help most.
        Raises ProjectError: no vocabulary, no label to begin with; StoppedError when it was told to stop, with nothing
        written.
        """
        return label_by_propagation.propagate_labels(self, spread, stage, report, keeping)

    def propose_propagated(
        self,
        vocabulary: Sequence[str] | None = None,
        *,
        spread: ExecutionOptions = IN_PROCESS,
        stage: Stage = ignore_stage,
    ) -> Proposals:
        """What `propagate_labels` would give, with nothing written; vocabulary: one to be tried."""
        return label_by_propagation.propose_propagated(self, vocabulary, spread, stage)

    def label_with_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[Usage], None] | None = None,
        stop: Callable[[], bool] | None = None,
        keeping: Callable[[], AbstractContextManager[object]] | None = None,
        spread: ExecutionOptions = IN_PROCESS,
    ) -> VlmResult:
        """Ask a vision-language model for labels; what a person or a file says stays.

        settings: those of the project when None. progress: called for each asset, with what was spent so far; stop:
        says when to ask no more; keeping: the block in which all labels are written, in the end; None writes those of
        an asset as soon as all is said of it; spread: how pictures are drawn. Answers are kept, so that none is paid
        for twice. Raises MeshForgeError where nothing could be asked at all.
        """
        return vlm_labelling.label_with_vlm(self, settings or self.settings.vlm, progress, stop, keeping, spread)

    def forecast_vlm(
        self,
        settings: VlmSettings | None = None,
        *,
        progress: Callable[[], None] | None = None,
        stop: Callable[[], bool] | None = None,
        vocabulary: Sequence[str] | None = None,
        spread: ExecutionOptions = IN_PROCESS,
    ) -> VlmForecast:
        """What `label_with_vlm` would send and cost, with nothing sent; the same options; vocabulary: another one."""
        return vlm_forecast.forecast_vlm(self, settings or self.settings.vlm, progress, stop, vocabulary, spread)

    # Demonstrations

    def demonstrations(self) -> dict[str, Demonstration]:
        """What was demonstrated, by asset."""
        return demonstrate_module.demonstrations(self)

    def steps(self, asset: str) -> tuple[Step, ...]:
        """The steps that were demonstrated on an asset; none where nothing was."""
        return steps_module.read_steps(self.layout.demonstration(asset))

    def demonstrate(self, asset: str, steps: Iterable[Step]) -> None:
        """Set the steps that are demonstrated on an asset; no steps take the demonstration away."""
        demonstrate_module.demonstrate(self, asset, tuple(steps))

    def move_rule(self, rule: int, to: int) -> None:
        """Put a rule at another place in all demonstrations and answers. Raises UsageError for a wrong number."""
        demonstrate_module.move_rule(self, rule, to)

    def delete_rule(self, rule: int) -> None:
        """Take a rule out of all demonstrations, and the answers about it. Raises UsageError for a wrong number."""
        demonstrate_module.delete_rule(self, rule)

    # The program

    def templates(self, names: Iterable[str]) -> dict[str, Template]:
        """Hull templates by the names that programs write. Raises ProgramError where one is not there or not convex."""
        return load_named_templates(names, self.layout.templates)

    def template_names(self) -> tuple[str, ...]:
        """The names of all templates in the project's folder of them, as actions write them."""
        return program_module.list_templates(self)

    def add_template(self, name: str, data: bytes) -> None:
        """Keep the contents of a mesh file as a template. Raises ProjectError: no plain name, or no convex hulls."""
        program_module.add_template(self, name, data)

    def program(self) -> Program | None:
        """The accepted program, None where there is none yet. Raises ProgramError where it does not parse."""
        return Program.read(self.layout.program) if self.layout.program.exists() else None

    def accept(self, program: Program) -> None:
        """Make it the project's program."""
        program_module.write_program(self, program)

    def program_state(self) -> ProgramState:
        """How the program stands to what it was learned from, and whether a person wrote it."""
        return accept_module.read_program_state(self)

    def synthesize(
        self,
        *,
        accept: bool = True,
        options: Options | None = None,
        confirm: Callable[[Repair], bool] | None = None,
        stop: Callable[[], bool] | None = None,
        answers: Sequence[Answer] = (),
        meshes: Mapping[str, SymbolicMesh] | None = None,
    ) -> Lesson:
        """Learn the program from the demonstrations and from what a person said since.

        accept: what is found becomes the project's program, and what `confirm` says about repairs is kept at once.
        confirm, stop: as of `meshforge.synthesize`; answers: for this lesson, before those that are kept.
        meshes: the assets by id, where they are in memory already (`Family`); else they are read, of very many some.
        """
        how = learn.LearnOptions(
            accept=accept, options=options, confirm=confirm, stop=stop, answers=answers, meshes=meshes
        )
        return learn.learn_program(self, how)

    def mesh_before_rule(
        self, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
    ) -> SymbolicMesh:
        """An asset as a rule of a program meets it: turned, and edited by the rules before."""
        return run.mesh_before_rule(self, asset, rule, program, meshes)

    # What a person said while it was learned

    def answers(self) -> AnswersFile:
        """All answers to questions, and all repairs of labels that were confirmed or refused."""
        return feedback.read_answers(self)

    def answer(self, question: Question, choice: int | None) -> str:
        """Answer a question by a choice, counted from 0, or by None for neither; give the answer's id `RULE:ASSET`."""
        return self.add_answer(answer_module.answer_by_choice(question, choice))

    def add_answer(self, answer: Answer) -> str:
        """The same for any selection, whether it was asked for or not. Raises ProjectError: no such asset or rule."""
        return answer_module.add_answer(self, answer)

    def confirm(self, right: LabelCorrection) -> str:
        """Repair a label, as a `Repair` proposes it or not; give the repair's id `ASSET#HULL=LABEL`.

        Raises ProjectError where the asset, the hull or the label is not there, or the hull has another label by now.
        """
        return answer_module.confirm_repair(self, right)

    def reject(self, wrong: LabelCorrection) -> str:
        """Refuse a repair, so that it is not proposed again; give its id."""
        return answer_module.reject_repair(self, wrong)

    def take_back(self, said: str) -> str | None:
        """Take back an answer or a repair by its id; the hull of a confirmed repair gets the label it had before.

        Gives a sentence where that label was changed since, and is left alone. Raises ProjectError for an unknown id.
        """
        return answer_module.take_back(self, said)

    def forget_answers(self) -> tuple[str, ...]:
        """Take back everything; gives the sentences about labels that are left alone."""
        return answer_module.take_back_all(self)

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
        program, work, templates = run.build_work(self, only)
        out = out or self.layout.edited
        return apply(program, work, out, templates=templates, options=options, execution=execution)

    def work(self) -> tuple[Program, tuple[AssetJob, ...], Mapping[str, Template]]:
        """What `apply` runs: the program, a job for each asset, and the templates. Raises ProjectError: no program."""
        return run.build_work(self, None)

    # After the program

    def corrections(self, asset: str) -> tuple[Correction, ...]:
        """The edits by hand that are replayed on an asset after the program."""
        return steps_module.read_corrections(self.layout.corrections(asset))

    def correct(self, asset: str, select: Iterable[str], action: Action, label: str | None = None) -> None:
        """Add an edit by hand on hulls of an asset, by the names they have after the program and the edits before."""
        run.correct(self, asset, sorted(set(select)), action, label)

    def drop_corrections(self, asset: str) -> None:
        """Take all edits by hand away from an asset."""
        run.drop_corrections(self, asset)

    def reviews(self) -> dict[str, Review]:
        """What a person said about edited assets."""
        return feedback.read_reviews(self.layout.review)

    def review(self, assets: str | Iterable[str], verdict: Verdict | None, note: str | None = None) -> None:
        """Accept or flag the output of one or several assets, or take that back by None; it counts until that changes.

        One that is accepted by itself was looked at: learning keeps to what the program selected there.
        Raises ProjectError, with nothing written, where there is no output that a verdict could be about.
        """
        review_module.review_assets(self, [assets] if isinstance(assets, str) else assets, verdict, note)

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
        return overview.compute_status(self, only, others, workers, progress, stop)
