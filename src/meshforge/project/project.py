"""The project folder: its state lies in files alone, every change is one atomic write under the project's lock."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path

from meshforge.batch import SETTINGS, TIMEOUT, Correction, Found, Outcome, expand, labels_for, locked, named_templates
from meshforge.errors import MeshForgeError, ProjectError, UsageError, nearest
from meshforge.formats import Mass
from meshforge.geometry.decompose import CoacdSettings, DecomposeSettings
from meshforge.language import Action, Orient, Program, Template
from meshforge.preparation import Preparation, cut_hull, read_preparation, read_prepared
from meshforge.project import (
    accepting,
    answering,
    applying,
    correcting,
    decomposing,
    demonstrating,
    labelling,
    learning,
    meeting,
    overview,
    preparing,
    reviewing,
)
from meshforge.project.answers_file import AnswersFile
from meshforge.project.labelling import Labelled
from meshforge.project.layout import Layout
from meshforge.project.preparing import Prepared
from meshforge.project.reviewing import Review, Verdict
from meshforge.project.settings import (
    Settings,
    change_setting,
    orientation,
    orientation_text,
    parse_orientation,
    read_settings,
    seen_from,
    write_settings,
)
from meshforge.project.status import Status
from meshforge.symbolic import Label, LabelFile, Source, SymbolicMesh, follow_labels, read_labels
from meshforge.synthesis import Answer, Demonstration, Options, Question, Repair, Step
from meshforge.synthesis import Outcome as Lesson


@dataclass(frozen=True)
class Project:
    """A project folder. Nothing but paths is held in memory: what is asked for is read, what is set is written.

    found: the assets, as they were when the project was opened.
    """

    folder: Path
    found: Found = field(repr=False)

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
        if not str(folder):
            raise UsageError("the folder to make has no name", remedy="Name it; . is the one you are in.")
        folder = Path(folder).absolute()
        if (folder / SETTINGS).exists():
            raise ProjectError("there is a project here already", where=str(folder), remedy="Choose another folder.")
        found = expand(assets)
        text = orient if isinstance(orient, str) else orientation_text(orient)
        parse_orientation(text)
        settings = Settings(
            name=name or folder.name,
            assets=tuple(seen_from(folder, str(pattern)) for pattern in assets),
            base=seen_from(folder, str(found.base)),
            vocabulary=tuple(vocabulary),
            orient=text,
        )
        write_settings(folder, settings)
        return Project.open(folder)

    @staticmethod
    def open(folder: str | Path) -> Project:
        """The project in a folder. Raises ProjectError: none there, its settings do not fit, or an asset is gone."""
        folder = Path(folder).absolute()
        settings = read_settings(folder)
        base = Path(os.path.normpath(folder / settings.base))
        try:
            found = Found(base, expand(settings.assets, folder).paths)
        except UsageError as error:
            raise ProjectError(f"assets: {error.message}", where=str(folder / SETTINGS)) from None
        for key in found.ids:
            if key.startswith("../"):
                raise ProjectError(
                    f"the asset {key} lies outside of {base}, the folder that ids count from",
                    where=str(folder / SETTINGS),
                    remedy="Make another project for it, or move it there.",
                )
        return Project(folder, found)

    @property
    def layout(self) -> Layout:
        """Where everything lies."""
        return Layout(self.folder)

    def lock(self) -> AbstractContextManager[None]:
        """The project's lock, under which files are read, changed and written."""
        return locked(self.layout.lock, str(self.folder))

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
        Program(labels=tuple(labels))
        with self.lock():
            change_setting(self.folder, "vocabulary", tuple(labels))

    def set_orientation(self, orient: Orient | str | None) -> None:
        """Set the orientation directive; a text has the form it has in a program."""
        directive = parse_orientation(orient) if isinstance(orient, str) else orient
        with self.lock():
            change_setting(self.folder, "orient", orientation_text(directive))

    # Assets

    def assets(self) -> tuple[str, ...]:
        """The ids of all assets."""
        return tuple(self.found.ids)

    def path(self, asset: str) -> Path:
        """The file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
        ids = self.found.ids
        if asset not in ids:
            like = nearest(asset, ids)
            remedy = f"Did you mean {like!r}?" if like else f"See them with: meshforge status {self.folder}"
            raise ProjectError(f"there is no asset {asset!r}", where=str(self.folder), remedy=remedy)
        return ids[asset]

    def mesh(self, asset: str) -> SymbolicMesh:
        """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        source = read_prepared(self.path(asset), self.layout.preparation(asset))
        mesh = follow_labels(self.labels(asset), SymbolicMesh.of(source)).mesh
        contact = self.settings.thresholds.contact
        return mesh if contact is None else replace(mesh, epsilon=contact)

    def meshes(self) -> Iterator[SymbolicMesh]:
        """All assets with their labels, one after the other; those that cannot be read are left out."""
        return (mesh for _, mesh in self.named_meshes())

    def named_meshes(self, assets: Iterable[str] | None = None) -> Iterator[tuple[str, SymbolicMesh]]:
        """The same with their ids, of some assets only."""
        for asset in self.assets() if assets is None else assets:
            try:
                yield asset, self.mesh(asset)
            except MeshForgeError:
                continue

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
    ) -> Iterator[Prepared]:
        """Make hulls of what has none: opaque pieces, and what bodies without collision geometry show.

        assets: all when None; settings: CoACD's defaults when None; only: names of pieces and bodies, or patterns;
        again: anew, also where that is done; hollow: shells of one sheet are not filled. workers, timeout [s] for an
        asset, progress: as of `meshforge.batch.apply`. What is done stays done when the caller stops in the midst.
        """
        return decomposing.decompose(
            self,
            self.assets() if assets is None else tuple(dict.fromkeys(assets)),
            settings or CoacdSettings(),
            only=only,
            again=again,
            hollow=hollow,
            workers=workers,
            timeout=timeout,
            progress=progress,
        )

    def cut(self, asset: str, hull: str, at: Sequence[float], across: Sequence[float]) -> Prepared:
        """Cut a hull along the plane through `at` (3,) [m] across `across` (3,), in the frame that the asset comes in.

        Raises GeometryError: no such hull, or a plane that misses it.
        """
        return preparing.change(self, asset, lambda source, before: cut_hull(source, before, hull, at, across))

    def split(
        self, asset: str, hull: str, settings: DecomposeSettings | None = None, *, hollow: bool = False
    ) -> Prepared:
        """Split a hull by a decomposition of what its body shows, or of the opaque piece that it was made of.

        Raises GeometryError: no such hull, nothing to decompose, or nothing that divides it.
        """
        return preparing.split(self, asset, hull, settings or CoacdSettings(), hollow)

    def unprepare(self, asset: str, *, everything: bool = False) -> Prepared:
        """Take back the last thing that was done to an asset before the program, or everything.

        Everything also of an asset that is gone or cannot be read. Raises ProjectError where nothing was done.
        """
        return preparing.unprepare(self, asset, everything)

    # Labels

    def labels(self, asset: str) -> LabelFile:
        """The labels of an asset as they are kept; empty where there are none."""
        path = self.layout.labels(asset)
        return read_labels(path) if path.exists() else LabelFile()

    def set_labels(
        self, asset: str, labels: Mapping[str, str | None], *, source: Source = "user", confidence: float = 1.0
    ) -> Labelled:
        """Label some hulls of an asset, or take labels away by None. A machine's source never overwrites a person's."""
        given = {name: Label(label, confidence, source) for name, label in labels.items() if label is not None}
        away = [name for name, label in labels.items() if label is None]
        with self.lock():
            return labelling.give(self, asset, given, away)

    def label_from_files(self, source: Path | None = None) -> tuple[Labelled, ...]:
        """Take over labels files: a file for a single asset, a folder that mirrors the assets, or those beside them."""
        given = {asset: labels_for(path, source, self.found.base) for asset, path in self.found.ids.items()}
        return labelling.take_over(self, given)

    # Demonstrations

    def demonstrations(self) -> dict[str, Demonstration]:
        """What was demonstrated, by asset."""
        ids = [asset for asset in self.assets() if self.layout.demonstration(asset).exists()]
        return {asset: Demonstration(self.mesh(asset), self.steps(asset), asset) for asset in ids}

    def steps(self, asset: str) -> tuple[Step, ...]:
        """The steps that were demonstrated on an asset; none where nothing was."""
        return demonstrating.steps(self.layout.demonstration(asset))

    def demonstrate(self, asset: str, steps: Iterable[Step]) -> None:
        """Set the steps that are demonstrated on an asset; no steps take the demonstration away."""
        demonstrating.demonstrate(self, asset, tuple(steps))

    # The program

    def templates(self, names: Iterable[str]) -> dict[str, Template]:
        """Hull templates by the names that programs write. Raises ProgramError where one is not there or not convex."""
        return named_templates(names, self.layout.templates)

    def program(self) -> Program | None:
        """The accepted program, None where there is none yet. Raises ProgramError where it does not parse."""
        return Program.read(self.layout.program) if self.layout.program.exists() else None

    def accept(self, program: Program) -> None:
        """Make it the project's program."""
        accepting.accept(self, program)

    def synthesize(
        self,
        *,
        accept: bool = True,
        options: Options | None = None,
        confirm: Callable[[Repair], bool] | None = None,
        stop: Callable[[], bool] | None = None,
        answers: Sequence[Answer] = (),
        meshes: Mapping[str, SymbolicMesh] | None = None,
        follow: Program | None = None,
    ) -> Lesson:
        """Learn the program from the demonstrations and from what a person said since.

        accept: what is found becomes the project's program, and what `confirm` says about repairs is kept at once.
        confirm, stop: as of `meshforge.synthesize`; answers: for this lesson, before those that are kept.
        meshes: the assets by id, where they are in memory already (`Family`); else they are read, of very many some.
        follow: a program somebody had in mind; the outcome tells what became of it.
        """
        how = learning.LessonPlan(
            accept=accept,
            options=options,
            confirm=confirm,
            stop=stop,
            answers=answers,
            meshes=meshes,
            follow=follow,
        )
        return learning.learn(self, how)

    def met(
        self, asset: str, rule: int, program: Program, meshes: Mapping[str, SymbolicMesh] | None = None
    ) -> SymbolicMesh:
        """An asset as a rule of a program meets it: turned, and edited by the rules before."""
        return meeting.met(self, asset, rule, program, meshes)

    # What a person said while it was learned

    def answers(self) -> AnswersFile:
        """All answers to questions, and all repairs of labels that were confirmed or refused."""
        return answering.answers(self)

    def answer(self, question: Question, choice: int | None) -> str:
        """Answer a question by a choice, counted from 0, or by None for neither; give the answer's id `RULE:ASSET`."""
        return self.add_answer(answering.chosen(question, choice))

    def add_answer(self, answer: Answer) -> str:
        """The same for any selection, whether it was asked for or not. Raises ProjectError: no such asset or rule."""
        return answering.answer(self, answer)

    def confirm(self, repair: Repair) -> str:
        """Repair a label as proposed; give the repair's id `ASSET#HULL=LABEL`.

        Raises ProjectError where the asset, the hull or the label is not there, or the hull has another label by now.
        """
        return answering.confirm(self, repair.correction)

    def reject(self, repair: Repair) -> str:
        """Refuse a repair, so that it is not proposed again; give its id."""
        return answering.reject(self, repair.correction)

    def take_back(self, said: str) -> str | None:
        """Take back an answer or a repair by its id; the hull of a confirmed repair gets the label it had before.

        Gives a sentence where that label was changed since, and is left alone. Raises ProjectError for an unknown id.
        """
        return answering.take_back(self, said)

    def forget_answers(self) -> tuple[str, ...]:
        """Take back everything; gives the sentences about labels that are left alone."""
        return answering.forget(self)

    def apply(
        self,
        *,
        out: Path | None = None,
        workers: int | None = None,
        mass: Mass = "keep",
        link: bool = False,
        dry_run: bool = False,
        resume: bool = True,
        progress: Callable[[], None] | None = None,
    ) -> Iterator[Outcome]:
        """Run the program on all assets, into `edited/` or `out`; all else as of `meshforge.batch.apply`."""
        return applying.apply_program(
            self,
            out or self.layout.edited,
            workers=workers,
            mass=mass,
            link=link,
            dry_run=dry_run,
            resume=resume,
            progress=progress,
        )

    # After the program

    def corrections(self, asset: str) -> tuple[Correction, ...]:
        """The edits by hand that are replayed on an asset after the program."""
        return correcting.corrections(self.layout.corrections(asset))

    def correct(self, asset: str, select: Iterable[str], action: Action, label: str | None = None) -> None:
        """Add an edit by hand on hulls of an asset, by the names they have after the program and the edits before."""
        correcting.correct(self, asset, sorted(set(select)), action, label)

    def drop_corrections(self, asset: str) -> None:
        """Take all edits by hand away from an asset."""
        with self.lock():
            self.layout.corrections(asset).unlink(missing_ok=True)

    def reviews(self) -> dict[str, Review]:
        """What a person said about edited assets."""
        return reviewing.reviews(self.layout.review)

    def review(self, asset: str, verdict: Verdict | None, note: str | None = None) -> None:
        """Accept or flag the output of an asset, or take that back by None; it counts until the output changes."""
        reviewing.review(self, asset, verdict, note)

    def status(self, *, workers: int | None = None, progress: Callable[[], None] | None = None) -> Status:
        """How far everything is, what is stale, and the next sensible step."""
        return overview.status(self, workers, progress)
