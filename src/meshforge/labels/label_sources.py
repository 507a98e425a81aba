"""By what the hulls of a family were labelled, for new assets: files, names and plug-ins, as the project keeps it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from meshforge import batch
from meshforge.common import file_digest
from meshforge.formats import PointAlignment
from meshforge.labels.from_files.read import LabelFileOptions, find_file_in_mirror, label_file_beside, read_label_file
from meshforge.labels.label_by_plugin import ask_labeler
from meshforge.labels.merge import can_fill_gap, can_replace_less_certain, merge_labels
from meshforge.labels.names.label_by_names import match_names, name_patterns, names_of_mesh, to_label
from meshforge.store import LabelSourceLine, PreparationPlanFile, Settings, Store, read_json
from meshforge.symbolic import Label, SymbolicMesh

_OF_LABELS = {"file": "file", "names": "name"}  # what labels call these sources; that of the others is `plugin`


@dataclass(frozen=True, slots=True)
class FamilyLabelSources:
    """By what a project labelled its hulls, in the order that counts: files, then names and plug-ins as they came.

    folder: of the project; settings: its own, for the vocabulary and the patterns of names.
    """

    folder: Path
    settings: Settings
    lines: tuple[LabelSourceLine, ...]

    @staticmethod
    def of(store: Store) -> FamilyLabelSources:
        """What labelled a project, and is in its labels still; files beside new assets count in any case."""
        kept = read_json(store.layout.preparation_plan, PreparationPlanFile) or PreparationPlanFile()
        lines = {"file": LabelSourceLine(source="file")} | {one.source: one for one in kept.label_sources}
        lines.setdefault("names", LabelSourceLine(source="names"))  # projects of before this was kept
        wanted, seen = {_OF_LABELS.get(name, "plugin") for name in lines} - {"file"}, {"file"}
        for asset in store.assets():
            if wanted <= seen:
                break
            labels = store.labels(asset).labels.values()
            seen |= {one.source for own in labels for one in (own, own.given) if one}
        used = tuple(one for name, one in lines.items() if _OF_LABELS.get(name, "plugin") in seen)
        return FamilyLabelSources(store.folder, store.settings, used)

    def digest(self, asset: str, path: Path) -> str:
        """Equal where the sources say the same of an asset that is the same itself."""
        file = self._find_file(self.lines[0], asset, path)
        lines = [one.model_dump_json() for one in self.lines]
        own = [self.settings.vocabulary, [*self.settings.names.items()], file_digest(file) if file else None]
        return batch.text_digest(json.dumps([lines, own]))

    def label(self, asset: str, path: Path, mesh: SymbolicMesh) -> tuple[dict[str, Label], list[str]]:
        """Labels of the hulls that have none, by name; and a sentence on each that was left out.

        path: the asset's file. Raises AssetError: a file beside it is damaged; PluginError: a labeller fails.
        """
        found, problems = dict[str, Label](), list[str]()
        words, hulls = self.settings.vocabulary, [hull.name for hull in mesh.hulls]
        for line in self.lines if words else ():
            may = can_fill_gap if line.source in _OF_LABELS else can_replace_less_certain
            given = dict(self._ask(line, asset, path, mesh))
            given = {name: one for name, one in given.items() if name not in mesh.labels and may(found.get(name), one)}
            found, outcome = merge_labels(asset, hulls, found, given, words)
            problems += outcome.problems
        return found, problems

    def _ask(self, line: LabelSourceLine, asset: str, path: Path, mesh: SymbolicMesh) -> Iterator[tuple[str, Label]]:
        """What one source says of an asset."""
        words = self.settings.vocabulary
        known = [(text, label) for text, label in line.patterns.items() if not label or label in words]
        patterns = name_patterns(self.folder, self.settings, words, known)
        if line.source == "names":
            matches = ((names.hull, match_names(names, words, patterns)) for names in names_of_mesh(mesh))
            yield from ((hull, label) for hull, one in matches if one and (label := to_label(one)))
        elif line.source != "file":
            yield from ask_labeler(line.source, mesh, words, str(path)).items()
        elif file := self._find_file(line, asset, path):
            options = LabelFileOptions((), line.classes, PointAlignment(line.align, line.points_up))
            yield from read_label_file(mesh, file, options, words, patterns).labels.items()

    def _find_file(self, line: LabelSourceLine, asset: str, path: Path) -> Path | None:
        folder = self.folder / line.folder if line.folder else None
        return (find_file_in_mirror(folder / asset, path) if folder else None) or label_file_beside(path)
