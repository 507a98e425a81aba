"""The project folder: its state lies in files alone, every change is one atomic write under the project's lock."""

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Self

from meshforge import batch, language, signoff, symbolic, synthesis
from meshforge.common import (
    FileState,
    MeshForgeError,
    ProjectError,
    file_state,
    nearest_name,
    relative_name,
    write_all_atomically,
    write_atomically,
)
from meshforge.formats import MESH_SUFFIXES
from meshforge.signoff.question import NOT_OF_FAMILY, ExclusionReason
from meshforge.store import program as program_files
from meshforge.store import settings as settings_file
from meshforge.store.events import Event, ExclusionEvent, SnoozeEvent, format_lines
from meshforge.store.feedback import Feedback, load_events, load_feedback, save_events
from meshforge.store.layout import Layout, read_derived, read_json, write_json
from meshforge.store.mesh_cache import MeshCache
from meshforge.store.meshes import AssetFiles, read_labels_file
from meshforge.store.sign_off import AssessmentFile, SignOff, load_sign_offs


@dataclass(frozen=True)
class Store:
    """A project folder. It holds nothing but paths in memory: what is asked for is read, what is set is written.

    every: all its assets, as they were when it was opened; cache: of meshes, so that they are not read again.
    """

    folder: Path
    every: batch.AssetSet = field(repr=False)
    cache: MeshCache | None = field(default=None, repr=False, compare=False)

    @classmethod
    def open(cls, folder: str | Path) -> Self:
        """Return the project in a folder. Raises ProjectError: none there, wrong settings, or an asset gone."""
        folder = Path(folder).absolute()
        return cls(folder, settings_file.find_assets(folder))

    @property
    def layout(self) -> Layout:
        """Where everything lies."""
        return Layout(self.folder)

    def lock(self) -> AbstractContextManager[None]:
        """Return the project's lock, under which files are read, changed and written; a thread may take it again."""
        return batch.hold_lock(self.layout.lock, str(self.folder), again=True)

    # Settings

    @property
    def settings(self) -> settings_file.Settings:
        return settings_file.read_settings(self.folder)

    @property
    def name(self) -> str:
        return self.settings.name

    @property
    def vocabulary(self) -> tuple[str, ...]:
        return self.settings.vocabulary

    @property
    def orientation(self) -> language.Orient | None:
        return settings_file.orientation(self.settings, self.folder)

    @property
    def words(self) -> tuple[str, ...]:
        """The vocabulary, and the classes of hulls that were demonstrated."""
        classes = {word for asset in self.demonstration_ids() for word in self.classes(asset).vocabulary}
        return (*self.vocabulary, *sorted(classes - set(self.vocabulary)))

    def set_vocabulary(self, labels: Sequence[str]) -> None:
        """Set the labels that hulls can have. Raises ProgramError for one that no program could write, UsageError for a
        name that stands for hulls of steps."""
        language.Program(labels=tuple(labels))  # raises ProgramError
        symbolic.refuse_class_names(labels)
        with self.lock():
            settings_file.change_setting(self.folder, "vocabulary", tuple(labels))

    def set_orientation(self, orient: language.Orient | str | None) -> None:
        """Set the orientation directive; a text has the form it has in a program. Raises ProjectError for another."""
        directive = settings_file.parse_orientation(orient) if isinstance(orient, str) else orient
        with self.lock():
            settings_file.change_setting(self.folder, "orient", settings_file.orientation_text(directive))

    def set_up(self, up: settings_file.Up) -> None:
        """Set the axis that points up in pictures of assets whose format does not say; empty for not known."""
        with self.lock():
            settings_file.change_setting(self.folder, "up", up or None)

    def add_extractors(self, names: Sequence[str]) -> None:
        """Let rules use leaf extractors of plug-ins, from now on. Raises UsageError where there is none of a name,
        PluginError where one cannot be loaded."""
        for name in names:
            language.EXTRACTORS.require(name)
        with self.lock():
            wanted = dict.fromkeys((*self.settings.extractors, *names))
            settings_file.change_setting(self.folder, "extractors", tuple(wanted))

    # Assets

    @property
    def found(self) -> batch.AssetSet:
        """The assets of the family: all but those that are excluded as not of it."""
        return self.every.without([asset for asset, why in self.exclusions().items() if why == NOT_OF_FAMILY])

    def assets(self) -> tuple[str, ...]:
        """Return the ids of all assets of the family."""
        return tuple(self.found.ids)

    def exclusions(self) -> Mapping[str, ExclusionReason]:
        """Return why assets are excluded, by id: from the family, or as not solved."""
        layout = self.layout
        return _read_exclusions(self.folder, file_state(layout.settings), file_state(layout.events))

    def exclude(self, assets: Collection[str], reason: ExclusionReason | None) -> None:
        """Exclude assets, or include them again by None; their files stay, and what is kept for them. Raises
        ProjectError for one that there is not, and where none of the family would be left."""
        for asset in assets:
            self.path(asset)
        if reason == NOT_OF_FAMILY and self.found.ids.keys() <= set(assets):
            remedy = "Add other assets first."
            raise ProjectError("no asset of the family would be left", where=str(self.folder), remedy=remedy)
        with self.lock():
            self._note_exclusions()
            self.add_events(*(ExclusionEvent(asset=asset, reason=reason) for asset in assets))

    def _note_exclusions(self) -> None:
        """Note as events, under the lock that the caller holds, what earlier versions noted in the settings."""
        settings = self.settings
        if before := dict.fromkeys((*settings.left_out, *settings.removed), NOT_OF_FAMILY):
            self.add_events(*(ExclusionEvent(asset=asset, reason=why) for asset, why in before.items()))
            after = settings_file.edit_settings(self.folder, {"left_out": None, "removed": None})
            write_atomically(self.layout.settings, after)

    def path(self, asset: str) -> Path:
        """Return the file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
        ids = self.every.ids
        if asset not in ids:
            by_name = {Path(key).name: key for key in ids}
            like = nearest_name(asset, ids) or by_name.get(nearest_name(Path(asset).name, by_name) or "")
            remedy = f"Did you mean {like!r}?" if like else f"See them with: meshforge status {self.folder}"
            raise ProjectError(f"there is no asset {asset!r}", where=str(self.folder), remedy=remedy)
        return ids[asset]

    def asset_files(self, assets: Iterable[str]) -> tuple[AssetFiles, ...]:
        """Return what each of some assets is read from, for reading it in another process."""
        layout, contact, up = self.layout, self.settings.thresholds.contact, self.settings.view_up
        return tuple(
            AssetFiles(self.path(a), layout.preparation(a), layout.labels(a), layout.classes(a), contact, up)
            for a in assets
        )

    def mesh(self, asset: str) -> symbolic.SymbolicMesh:
        """Return an asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        (files,) = self.asset_files([asset])
        return self.cache.get(files) if self.cache else files.read_mesh()

    def meshes_by_id(self, assets: Iterable[str] | None = None) -> Iterator[tuple[str, symbolic.SymbolicMesh]]:
        """Yield all assets, or some, with their ids and labels; those that cannot be read are left out."""
        for asset in self.assets() if assets is None else assets:
            try:
                yield asset, self.mesh(asset)
            except MeshForgeError:
                continue

    def readers(self, assets: Iterable[str]) -> tuple[Callable[[], symbolic.SymbolicMesh], ...]:
        """Return functions that read each of some assets as `mesh` does, in this process or another."""
        return tuple(files.read_mesh for files in self.asset_files(assets))

    def preparation(self, asset: str) -> batch.Preparation:
        """Return what is done to an asset before the program. Raises AssetError where its files are damaged."""
        self.path(asset)
        return batch.read_preparation(self.layout.preparation(asset)) or batch.Preparation()

    # Labels

    def labels(self, asset: str) -> symbolic.LabelFile:
        """Return the labels file of an asset; an empty one where there is none."""
        return read_labels_file(self.layout.labels(asset))

    def labels_and_classes(self, asset: str) -> symbolic.LabelFile:
        """Return the same with the classes of hulls that have no label."""
        return self.labels(asset).fill(self.classes(asset))

    def classes(self, asset: str) -> symbolic.LabelFile:
        """Return the classes of the hulls of an asset; an empty file where there are none that can be read."""
        return symbolic.read_classes(self.layout.classes(asset))

    def write_classes(self, texts: Mapping[str, str | None]) -> None:
        """Write files of classes, by asset, under the lock that the caller holds; None removes one."""
        write_all_atomically({self.layout.classes(asset): text for asset, text in texts.items()})

    def write_labels(
        self, asset: str, hulls: Mapping[str, str], labels: Mapping[str, symbolic.Label], vocabulary: Sequence[str]
    ) -> None:
        """Write the labels of an asset, under the lock that the caller holds; without any label its file is removed.

        Labels of hulls that are gone stay in the file, since hulls may come back. hulls: the digests of all, by name,
        in order.
        """
        self.write_labels_files({asset: self.labels_text(asset, hulls, labels, vocabulary)})

    def labels_text(
        self,
        asset: str,
        hulls: Mapping[str, str],
        labels: Mapping[str, symbolic.Label],
        vocabulary: Sequence[str],
        away: Collection[str] = (),
    ) -> str | None:
        """Return what `write_labels` writes; None where the file is to be removed. away: names of hulls that are gone
        whose labels do not stay."""
        path, present = self.layout.labels(asset), {name: labels[name] for name in hulls if name in labels}
        text = symbolic.format_labels(symbolic.LabelFile(tuple(vocabulary), present, hulls))
        gone = [name for name in symbolic.match_labels(read_labels_file(path), hulls).gone if name not in away]
        if gone:
            old, new = json.loads(path.read_bytes()), json.loads(text)
            new["hulls"] |= {name: old["hulls"][name] for name in gone}
            new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
            text = json.dumps(new, ensure_ascii=False, indent=2) + "\n"
        return text if present or gone else None

    def write_labels_files(self, texts: Mapping[str, str | None]) -> None:
        """Write labels files, by asset, under the lock that the caller holds; None removes one."""
        write_all_atomically({self.layout.labels(asset): text for asset, text in texts.items()})

    # Demonstrations, and edits by hand

    def demonstration_ids(self) -> tuple[str, ...]:
        """Return the ids of the assets that have a demonstration."""
        shown = set(self.layout.demonstration.ids)
        return tuple(asset for asset in self.assets() if asset in shown)

    def demonstrations(self) -> dict[str, synthesis.Demonstration]:
        """Return all demonstrations, by asset."""
        return {
            asset: synthesis.Demonstration(self.mesh(asset), self.steps(asset), asset)
            for asset in self.demonstration_ids()
        }

    def steps(self, asset: str) -> tuple[synthesis.Step, ...]:
        """Return the steps that were demonstrated on an asset; none where nothing was."""
        return program_files.read_steps(self.layout.demonstration(asset))

    def write_steps(self, asset: str, steps: Sequence[synthesis.Step]) -> None:
        """Write the steps that are demonstrated on an asset; without any step its file is removed."""
        with self.lock():
            program_files.write_steps(self.layout.demonstration(asset), asset, steps)

    def manual_edits(self, asset: str) -> tuple[batch.ManualEdit, ...]:
        """Return the edits by hand that are replayed on an asset after the program."""
        return program_files.read_manual_edits(self.layout.manual_edits(asset))

    def write_manual_edits(self, asset: str, manual_edits: Sequence[batch.ManualEdit]) -> None:
        """Write the edits by hand of an asset; without any its file is removed."""
        with self.lock():
            program_files.write_manual_edits(self.layout.manual_edits(asset), asset, manual_edits)

    # The program

    def program(self) -> language.Program | None:
        """Return the accepted program, None where there is none yet. Raises ProgramError where it does not parse."""
        return language.Program.read(self.layout.program) if self.layout.program.exists() else None

    def write_program(self, program: language.Program) -> None:
        """Write the accepted program; the one before stays as `program.previous.mf`."""
        with self.lock():
            program_files.write_program(self.layout, program)

    def program_record(self) -> program_files.ProgramRecord | None:
        """Return what the program was learned from; None where none was learned."""
        return read_json(self.layout.learned, program_files.ProgramRecord)

    def write_program_record(self, record: program_files.ProgramRecord) -> None:
        """Write what the program was learned from."""
        with self.lock():
            write_json(self.layout.learned, record)

    def templates(self, names: Iterable[str]) -> dict[str, language.Template]:
        """Hull templates by the names that programs write. Raises ProgramError where one is not there or not convex."""
        return batch.load_templates(names, self.layout.templates)

    def templates_in(self, demos: Iterable[synthesis.Demonstration]) -> dict[str, language.Template]:
        """Return the templates that the steps of demonstrations name. Raises as `templates`."""
        return self.templates(dict.fromkeys(n for demo in demos for step in demo.steps for n in step.action.templates))

    def template_names(self) -> tuple[str, ...]:
        """Return the names of all templates in the project's folder of them, as actions write them."""
        folder = self.layout.own_templates
        paths = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
        return tuple(sorted(relative_name(path, folder) for path in paths if path.suffix.lower() in MESH_SUFFIXES))

    # What a person said

    def feedback(self) -> Feedback:
        """Return what all that people said comes to. Raises ProjectError, naming file and line."""
        return load_feedback(self.layout)

    def add_events(self, *events: Event) -> None:
        """Keep what a person said, all or nothing."""
        with self.lock():
            save_events(self.layout, [*load_events(self.layout), *events])

    def add_events_before(self, effect: Callable[[], object], *events: Event) -> None:
        """Keep what a person said, then do what follows from it; where that fails, nothing is kept.

        In this order: killed in between, the question is asked still, and the same reply does the rest.
        """
        with self.lock():
            self.add_events(*events)
            try:
                effect()
            except MeshForgeError:
                self.change_events(lambda every: every[: -len(events)])
                if not self.layout.events.stat().st_size:
                    self.layout.events.unlink()
                raise

    def ask_again(self) -> None:
        """Ask all questions that were snoozed."""
        if self.feedback().snoozed:
            self.add_events(SnoozeEvent())

    def change_events(self, change: Callable[[tuple[Event, ...]], Iterable[Event]]) -> None:
        """Write other events in the place of all that there are, where anything is other."""
        with self.lock():
            before = load_events(self.layout)
            after = tuple(change(before))
            if after != before:
                save_events(self.layout, after)

    def sign_offs(self) -> dict[str, SignOff]:
        """Return which assets are signed off, by asset."""
        return load_sign_offs(self.layout.sign_offs)

    def write_sign_offs(self, signed: Mapping[str, SignOff]) -> None:
        """Write which assets are signed off, under the lock that the caller holds."""
        if signed != self.sign_offs():
            write_atomically(self.layout.sign_offs, format_lines([one for _, one in sorted(signed.items())]))

    def assessment(self) -> AssessmentFile | None:
        """Return how the family stood when it was looked at last; None where that is not kept, or damaged."""
        return read_derived(self.layout.assessment, AssessmentFile)

    def reference_measures(self) -> list[signoff.EditMeasures]:
        """Return the measures of edits that a person showed, accepted or corrected, as the last review found them; of
        what was shown without misfits, which whoever shows it need not have seen."""
        last, demos = self.assessment(), self.demonstration_ids()
        found = [(asset, one.measures) for asset, one in last.assets.items() if one.looked_at] if last else []
        return [replace(one, misfits=()) if asset in demos else one for asset, one in found if one]

    def write_assessment(self, found: AssessmentFile) -> None:
        """Keep how the family stands."""
        with self.lock():
            write_json(self.layout.assessment, found)


@lru_cache(maxsize=4)
def _read_exclusions(
    folder: Path, settings: FileState | None, events: FileState | None
) -> Mapping[str, ExclusionReason]:
    """Read them from files in these states; they are asked for several times for every asset."""
    kept = settings_file.read_settings(folder)
    feedback = load_feedback(Layout(folder)).exclusions.items()
    before = dict.fromkeys((*kept.left_out, *kept.removed), NOT_OF_FAMILY)
    return MappingProxyType(before | {asset: one.reason for asset, one in feedback if one.reason})
