"""By what the hulls of a family were labelled, kept for its new assets: files, names and plug-ins."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from meshforge.common import relative_name, write_atomically
from meshforge.labels.from_files.label_by_files import (
    FileLabeler,
    LabelFileOptions,
    find_file_in_mirror,
    label_file_beside,
    read_label_file,
)
from meshforge.labels.label_by_inference import AllLabeler
from meshforge.labels.label_by_like import LikeLabeler
from meshforge.labels.labeler import Labeler
from meshforge.labels.merge import LabelOutcome, can_fill_gap, can_replace_less_certain, merge_labels
from meshforge.labels.names.label_by_names import NameLabeler, match_names, name_patterns, names_of_mesh, to_label
from meshforge.labels.registry import AssetLabeler, label_mesh
from meshforge.store import JsonFile, Settings, Store, read_json, write_json
from meshforge.symbolic import Label, SymbolicMesh

_OF_LABELS = {"file": "file", "names": "name"}  # what labels call these sources; that of the others is `plugin`


class LabelSourceLine(JsonFile):
    """One way in which hulls were labelled: `file`, `names`, or a plug-in's labeller. options: patterns that were given
    besides the project's, and how files are read; folder: of the files, as seen from the project, None for beside."""

    source: str
    options: LabelFileOptions = LabelFileOptions()
    folder: str | None = None


class LabelSourcesFile(JsonFile):
    """label_sources.json: by what hulls were labelled, in that order."""

    lines: tuple[LabelSourceLine, ...] = ()


def keep_label_source(store: Store, outcomes: Iterable[LabelOutcome], labeler: Labeler) -> None:
    """Keep by what hulls were labelled, if new assets can be labelled by that; patterns add to those before."""
    if isinstance(labeler, LikeLabeler) and labeler.fresh:
        with store.lock():
            write_atomically(store.layout.like(labeler.fresh[0]), labeler.fresh[1].format())
    some = (labeler.files, labeler.names) if isinstance(labeler, AllLabeler) else (labeler,)
    new = [line for one in some if (line := _line_of(store, one))]
    if not new or not any(one.taken or one.same or one.kept for one in outcomes):
        return
    with store.lock():
        kept = read_json(store.layout.label_sources, LabelSourcesFile) or LabelSourcesFile()
        lines = {one.source: one for one in kept.lines}
        for line in new:
            known = dict(lines[line.source].options.meanings) if line.source in lines else {}
            how = replace(line.options, meanings=tuple((known | dict(line.options.meanings)).items()))
            lines[line.source] = line.model_copy(update={"options": how})
        write_json(store.layout.label_sources, LabelSourcesFile(lines=tuple(lines.values())))


def _line_of(store: Store, labeler: Labeler) -> LabelSourceLine | None:
    if isinstance(labeler, NameLabeler):
        return LabelSourceLine(source=labeler.name, options=LabelFileOptions(labeler.meanings))
    if isinstance(labeler, FileLabeler):
        folder = labeler.source if labeler.source and labeler.source.is_dir() else None
        where = relative_name(folder, store.folder) if folder else None
        return LabelSourceLine(source=labeler.name, options=labeler.options, folder=where)
    return LabelSourceLine(source=labeler.name) if isinstance(labeler, AssetLabeler) else None


def rename_in_label_sources(kept: LabelSourcesFile, old: str, new: str) -> LabelSourcesFile:
    """Return the same where a label has another name."""
    lines = list[LabelSourceLine]()
    for one in kept.lines:
        meanings = tuple((text, new if label == old else label) for text, label in one.options.meanings)
        lines.append(one.model_copy(update={"options": replace(one.options, meanings=meanings)}))
    return LabelSourcesFile(lines=tuple(lines))


@dataclass(frozen=True, slots=True)
class FamilyLabelSources:
    """By what a project labelled its hulls: files, then names and plug-ins as they came. folder: of the project."""

    folder: Path
    settings: Settings
    lines: tuple[LabelSourceLine, ...]

    @staticmethod
    def of(store: Store) -> "FamilyLabelSources":
        """Return what labelled a project, and is in its labels still; files beside new assets count in any case."""
        kept = read_json(store.layout.label_sources, LabelSourcesFile) or LabelSourcesFile()
        lines = {"file": LabelSourceLine(source="file")} | {one.source: one for one in kept.lines}
        lines.setdefault("names", LabelSourceLine(source="names"))  # also where that file is gone
        kinds = {name: _OF_LABELS.get(name, "plugin") for name in lines}
        seen = {"file"}
        for asset in store.assets():
            if seen < {*kinds.values()}:
                rows = store.labels(asset).labels.values()
                seen |= {one.source for label in rows for one in (label, label.given) if one}
        return FamilyLabelSources(store.folder, store.settings, tuple(lines[n] for n in lines if kinds[n] in seen))

    def label(self, asset: str, path: Path, mesh: SymbolicMesh) -> tuple[dict[str, Label], list[str]]:
        """Return labels of the hulls that have none, by name; and a sentence on each that was left out. path: the
        asset's.

        Raises AssetError: a file beside it is damaged; PluginError: a labeller fails.
        """
        found, problems = dict[str, Label](), list[str]()
        words, hulls = self.settings.vocabulary, [hull.name for hull in mesh.hulls]
        for line in self.lines if words else ():
            may = can_fill_gap if line.source in _OF_LABELS else can_replace_less_certain
            observed = self._ask(line, asset, path, mesh).items()
            given = {name: one for name, one in observed if name not in mesh.labels and may(found.get(name), one)}
            found, outcome = merge_labels(asset, hulls, found, given, words)
            problems += outcome.problems
        return found, problems

    def _ask(self, line: LabelSourceLine, asset: str, path: Path, mesh: SymbolicMesh) -> Mapping[str, Label]:
        words = self.settings.vocabulary
        known = [(text, label) for text, label in line.options.meanings if not label or label in words]
        patterns = name_patterns(self.folder, self.settings, words, known)
        if line.source == "names":
            matches = {names.hull: match_names(names, words, patterns) for names in names_of_mesh(mesh)}
            return {hull: label for hull, one in matches.items() if one and (label := to_label(one))}
        if line.source != "file":
            return label_mesh(line.source, mesh, words, str(path))
        file = self._find_file(line, asset, path)
        return read_label_file(mesh, file, line.options, words, patterns).labels if file else {}

    def _find_file(self, line: LabelSourceLine, asset: str, path: Path) -> Path | None:
        folder = self.folder / line.folder if line.folder else None
        return (find_file_in_mirror(folder / asset, path) if folder else None) or label_file_beside(path)
