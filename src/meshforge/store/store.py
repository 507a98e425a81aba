"""The project folder: its state lies in files alone, every change is one atomic write under the project's lock."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from meshforge import batch, language, signoff, symbolic, synthesis
from meshforge.common import MeshForgeError, ProjectError, nearest_name, write_all_atomically, write_atomically
from meshforge.store import membership
from meshforge.store import program as program_files
from meshforge.store import settings as settings_file
from meshforge.store.event_log import load_events, load_feedback, load_sign_offs, save_events, save_sign_offs
from meshforge.store.events import Event, ExclusionEvent, SnoozeEvent, VerdictEvent
from meshforge.store.feedback import Feedback
from meshforge.store.layout import Layout, read_derived, read_json, write_json
from meshforge.store.mesh_cache import MeshCache
from meshforge.store.meshes import AssetFiles, read_labels_file
from meshforge.store.preparation_plan import forget_assets
from meshforge.store.sign_off import AssessmentFile, SignOff


@dataclass(frozen=True)
class Store:
    """A project folder. It holds nothing but paths in memory: what is asked for is read, what is set is written.

    found: the assets, as they were when the project was opened; cache: of meshes, so that they are not read again.
    """

    folder: Path
    found: batch.AssetSet = field(repr=False)
    cache: MeshCache | None = field(default=None, repr=False, compare=False)

    @classmethod
    def open(cls, folder: str | Path) -> Self:
        """The project in a folder. Raises ProjectError: none there, its settings do not fit, or an asset is gone."""
        folder = Path(folder).absolute()
        return cls(folder, settings_file.find_assets(folder))

    @property
    def layout(self) -> Layout:
        """Where everything lies."""
        return Layout(self.folder)

    def lock(self) -> AbstractContextManager[None]:
        """The project's lock, under which files are read, changed and written; a thread may take it again and again."""
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

    def set_vocabulary(self, labels: Sequence[str]) -> None:
        """Set the labels that hulls can have. Raises ProgramError for one that no program could write."""
        language.Program(labels=tuple(labels))  # raises ProgramError
        with self.lock():
            settings_file.change_setting(self.folder, "vocabulary", tuple(labels))

    def set_orientation(self, orient: language.Orient | str | None) -> None:
        """Set the orientation directive; a text has the form it has in a program. Raises ProjectError for another."""
        directive = settings_file.parse_orientation(orient) if isinstance(orient, str) else orient
        with self.lock():
            settings_file.change_setting(self.folder, "orient", settings_file.orientation_text(directive))

    def add_extractors(self, names: Sequence[str]) -> None:
        """Let rules use leaf extractors of plug-ins, from now on. Raises UsageError where there is none of a name,
        PluginError where one cannot be loaded."""
        for name in names:
            language.EXTRACTORS.require(name)
        with self.lock():
            wanted = dict.fromkeys((*self.settings.extractors, *names))
            settings_file.change_setting(self.folder, "extractors", tuple(wanted))

    # Assets

    def assets(self) -> tuple[str, ...]:
        """The ids of all assets."""
        return tuple(self.found.ids)

    def path(self, asset: str) -> Path:
        """The file of an asset. Raises ProjectError, naming the nearest id, where there is no such asset."""
        ids = self.found.ids
        if asset not in ids:
            by_name = {Path(key).name: key for key in ids}
            like = nearest_name(asset, ids) or by_name.get(nearest_name(Path(asset).name, by_name) or "")
            remedy = f"Did you mean {like!r}?" if like else f"See them with: meshforge status {self.folder}"
            raise ProjectError(f"there is no asset {asset!r}", where=str(self.folder), remedy=remedy)
        return ids[asset]

    def asset_files(self, assets: Iterable[str]) -> tuple[AssetFiles, ...]:
        """What each of some assets is read from, for reading it in another process."""
        layout, contact = self.layout, self.settings.thresholds.contact
        return tuple(AssetFiles(self.path(a), layout.preparation(a), layout.labels(a), contact) for a in assets)

    def mesh(self, asset: str) -> symbolic.SymbolicMesh:
        """An asset as it is prepared, with its labels. Raises AssetError where it cannot be read."""
        (files,) = self.asset_files([asset])
        return self.cache.get(files) if self.cache else files.read_mesh()

    def meshes_by_id(self, assets: Iterable[str] | None = None) -> Iterator[tuple[str, symbolic.SymbolicMesh]]:
        """All assets, or some, with their ids and labels; those that cannot be read are left out."""
        for asset in self.assets() if assets is None else assets:
            try:
                yield asset, self.mesh(asset)
            except MeshForgeError:
                continue

    def readers(self, assets: Iterable[str]) -> tuple[Callable[[], symbolic.SymbolicMesh], ...]:
        """Functions that read each of some assets as `mesh` does, in this process or another."""
        return tuple(files.read_mesh for files in self.asset_files(assets))

    def preparation(self, asset: str) -> batch.Preparation:
        """What is done to an asset before the program. Raises AssetError where its files are damaged."""
        self.path(asset)
        return batch.read_preparation(self.layout.preparation(asset)) or batch.Preparation()

    def leave_out(self, assets: Collection[str]) -> None:
        """Leave assets out of the family; their files stay, and what is kept for them. Raises ProjectError for the last
        one."""
        with self.lock():
            membership.leave_out(self.folder, self.found, assets)

    def include_again(self, assets: Collection[str]) -> None:
        """Let assets that were left out be part of the family again."""
        with self.lock():
            membership.include_again(self.folder, assets)

    def remove_assets(self, assets: Collection[str]) -> None:
        """Remove assets from the project, with what it keeps for them; their own files stay. Raises ProjectError for
        the last one of the family."""
        with self.lock():
            membership.remove_from_settings(self.folder, self.found, assets)
            for asset in assets:
                batch.write_preparation(self.layout.preparation(asset), batch.Preparation())
                for path in self.layout.list_kept(asset):
                    if path.is_file():
                        path.unlink()
            feedback = self.feedback()
            verdicts = [VerdictEvent(asset=asset) for asset in assets if feedback.verdict_on(asset)]
            exclusions = [ExclusionEvent(asset=asset) for asset in assets if asset in feedback.exclusions]
            if verdicts or exclusions:
                self.add_events(*verdicts, *exclusions)
            forget_assets(self.layout, assets)

    # Labels

    def labels(self, asset: str) -> symbolic.LabelFile:
        """The labels file of an asset; an empty one where there is none."""
        return read_labels_file(self.layout.labels(asset))

    def write_labels(
        self,
        asset: str,
        hulls: Mapping[str, str],
        labels: Mapping[str, symbolic.Label],
        vocabulary: Sequence[str],
        away: Collection[str] = (),
    ) -> None:
        """Write the labels of an asset, under the lock that the caller holds; without any label its file is removed.

        Labels of hulls that are gone stay in the file, since hulls may come back. hulls: the digests of all, by name,
        in order; away: names of hulls that are gone whose labels do not stay.
        """
        self.write_labels_files({asset: self.labels_text(asset, hulls, labels, vocabulary, away)})

    def labels_text(
        self,
        asset: str,
        hulls: Mapping[str, str],
        labels: Mapping[str, symbolic.Label],
        vocabulary: Sequence[str],
        away: Collection[str] = (),
    ) -> str | None:
        """What `write_labels` writes; None where the file is to be removed."""
        path, present = self.layout.labels(asset), {name: labels[name] for name in hulls if name in labels}
        text = symbolic.format_labels(symbolic.LabelFile(tuple(vocabulary), present, hulls))
        if gone := [name for name in symbolic.match_labels(self.labels(asset), hulls).gone if name not in away]:
            old, new = json.loads(path.read_text(encoding="utf-8")), json.loads(text)
            new["hulls"] |= {name: old["hulls"][name] for name in gone}
            new["vocabulary"] = list(dict.fromkeys([*new["vocabulary"], *old.get("vocabulary", [])]))
            text = json.dumps(new, ensure_ascii=False, indent=2) + "\n"
        return text if present or gone else None

    def write_labels_files(self, texts: Mapping[str, str | None]) -> None:
        """Write labels files, by asset, under the lock that the caller holds; None removes one."""
        write_all_atomically({self.layout.labels(asset): text for asset, text in texts.items() if text is not None})
        for asset, text in texts.items():
            if text is None:
                self.layout.labels(asset).unlink(missing_ok=True)

    # Demonstrations, and edits by hand

    def demonstration_ids(self) -> tuple[str, ...]:
        """The ids of the assets that have a demonstration."""
        shown = set(self.layout.demonstration.ids)
        return tuple(asset for asset in self.assets() if asset in shown)

    def demonstrations(self) -> dict[str, synthesis.Demonstration]:
        """All demonstrations, by asset."""
        return {
            asset: synthesis.Demonstration(self.mesh(asset), self.steps(asset), asset)
            for asset in self.demonstration_ids()
        }

    def steps(self, asset: str) -> tuple[synthesis.Step, ...]:
        """The steps that were demonstrated on an asset; none where nothing was."""
        return program_files.read_steps(self.layout.demonstration(asset))

    def write_steps(self, asset: str, steps: Sequence[synthesis.Step]) -> None:
        """Write the steps that are demonstrated on an asset; without any step its file is removed."""
        with self.lock():
            program_files.write_steps(self.layout.demonstration(asset), asset, steps)

    def manual_edits(self, asset: str) -> tuple[batch.ManualEdit, ...]:
        """The edits by hand that are replayed on an asset after the program."""
        return program_files.read_manual_edits(self.layout.manual_edits(asset))

    def write_manual_edits(self, asset: str, manual_edits: Sequence[batch.ManualEdit]) -> None:
        """Write the edits by hand of an asset."""
        with self.lock():
            program_files.write_manual_edits(self.layout.manual_edits(asset), asset, manual_edits)

    def drop_manual_edits(self, asset: str) -> None:
        """Remove all edits by hand of an asset."""
        with self.lock():
            self.layout.manual_edits(asset).unlink(missing_ok=True)

    # The program

    def program(self) -> language.Program | None:
        """The accepted program, None where there is none yet. Raises ProgramError where it does not parse."""
        return language.Program.read(self.layout.program) if self.layout.program.exists() else None

    def write_program(self, program: language.Program) -> None:
        """Write the accepted program; the one before stays as `program.previous.mf`."""
        with self.lock():
            program_files.write_program(self.layout, program)

    def program_record(self) -> program_files.ProgramRecord | None:
        """What the program was learned from; None where none was learned."""
        kept = read_json(self.layout.learned, program_files.ProgramRecord)
        return kept or read_json(self.layout.learned_before, program_files.ProgramRecord)

    def write_program_record(self, record: program_files.ProgramRecord) -> None:
        """Write what the program was learned from."""
        with self.lock():
            write_json(self.layout.learned, record)
            self.layout.learned_before.unlink(missing_ok=True)

    def templates(self, names: Iterable[str]) -> dict[str, language.Template]:
        """Hull templates by the names that programs write. Raises ProgramError where one is not there or not convex."""
        return batch.load_named_templates(names, self.layout.templates)

    def template_names(self) -> tuple[str, ...]:
        """The names of all templates in the project's folder of them, as actions write them."""
        return program_files.list_templates(self.layout)

    def add_template(self, name: str, data: bytes) -> None:
        """Keep the contents of a mesh file as a template. Raises ProjectError: no plain name, or no convex hulls."""
        program_files.check_template(self.layout, name, data)
        with self.lock():
            write_atomically(self.layout.own_templates / name, data)

    # What a person said

    def feedback(self) -> Feedback:
        """What all that people said comes to. Raises ProjectError, naming file and line, where it cannot be read."""
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

    def migrate(self) -> None:
        """Keep as events what files of before there were events hold."""
        with self.lock():
            if not self.layout.events.exists() and (events := load_events(self.layout)):
                save_events(self.layout, events)

    def change_events(self, change: Callable[[tuple[Event, ...]], Iterable[Event]]) -> None:
        """Write other events in the place of all that there are, where anything is other."""
        with self.lock():
            before = load_events(self.layout)
            after = tuple(change(before))
            if after != before:
                save_events(self.layout, after)

    def sign_offs(self) -> dict[str, SignOff]:
        """Which assets are signed off, by asset."""
        return load_sign_offs(self.layout)

    def write_sign_offs(self, signed: Mapping[str, SignOff]) -> None:
        """Write which assets are signed off, under the lock that the caller holds."""
        if signed != self.sign_offs():
            self.migrate()
            save_sign_offs(self.layout, signed)

    def assessment(self) -> AssessmentFile | None:
        """How the family stood when it was looked at last; None where that is not kept, or damaged."""
        return read_derived(self.layout.assessment, AssessmentFile)

    def reference_measures(self) -> list[signoff.EditMeasures]:
        """The measures of edits that a person showed, accepted or corrected, as the last review found them."""
        last = self.assessment()
        return [one.measures for one in last.assets.values() if one.looked_at and one.measures] if last else []

    def write_assessment(self, found: AssessmentFile) -> None:
        """Keep how the family stands."""
        with self.lock():
            write_json(self.layout.assessment, found)
