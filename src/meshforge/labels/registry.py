"""The labelers by what `label --with` takes: those that are built in, one line each, and those of plug-ins."""

from abc import abstractmethod
from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from functools import partial
from inspect import isabstract
from typing import Any

from meshforge.batch import WorkerFailure, execute
from meshforge.common import Plugin, Registry, UsageError, blame, describe_error, suggest_among
from meshforge.labels.from_files.label_by_files import FileLabeler
from meshforge.labels.label_by_inference import AllLabeler, PropagationLabeler
from meshforge.labels.label_by_like import LikeLabeler
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.names.label_by_names import NameLabeler
from meshforge.labels.vlm.label_by_vlm import VlmLabeler
from meshforge.store import AssetFiles, hull_digests
from meshforge.symbolic import Label, SymbolicMesh

_BUILT_IN: tuple[type[Labeler], ...] = (
    AllLabeler,
    FileLabeler,
    NameLabeler,
    PropagationLabeler,
    LikeLabeler,
    VlmLabeler,
)


def _adopt(plugin: Plugin, kind: Any) -> type[Labeler]:
    """The class of a plug-in's labeler. Raises PluginError where it does not fit."""
    if not (isinstance(kind, type) and issubclass(kind, Labeler)):
        raise plugin.error("does not fit: it is no subclass of meshforge.labels.Labeler")
    if isabstract(kind):
        raise plugin.error(f"does not fit: it has no method {min(kind.__abstractmethods__)}")
    return kind


LABELERS: Registry[type[Labeler]] = Registry("labelers", {kind.name: kind for kind in _BUILT_IN}, _adopt)


def make_labeler(name: str) -> Labeler:
    """Return a labeler without options. Raises UsageError: not known; PluginError: it cannot be loaded."""
    if name == "consensus":
        raise UsageError("--with consensus is a part of --with propagate now", remedy="Use --with propagate.")
    if name not in LABELERS:
        raise UsageError(f"there are no labels from {name!r}", remedy=suggest_among(name, LABELERS, "--with takes"))
    labeler = LABELERS[name]()
    labeler.name = name
    return labeler


class AssetLabeler(Labeler):
    """A labeler of a plug-in that sees one mesh at a time; it is made anew for each asset, without arguments."""

    @abstractmethod
    def label(self, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> Mapping[str, Label]:
        """Return labels out of the vocabulary by the names of hulls, each with its confidence in 0..1.

        Hulls without a label are left out. The source of the labels is set to `plugin`.
        """

    def propose(self, family: LabelFamily) -> LabelProposal:
        return LabelProposal(_label_assets(self.name, family, family.require_vocabulary()))


def _label_assets(name: str, family: LabelFamily, vocabulary: tuple[str, ...]) -> Generator[AssetLabels, None, None]:
    assets = family.store.assets()
    items = list(zip(assets, family.store.asset_files(assets), strict=True))
    with closing(execute(partial(_label_asset, name, vocabulary), items, family.execution)) as results:
        for asset, found in zip(assets, results, strict=True):
            if isinstance(found, WorkerFailure):
                found = AssetLabels(asset, error=f"{family.store.path(asset)}: {found.why}")
            yield found


def _label_asset(name: str, vocabulary: tuple[str, ...], item: tuple[str, AssetFiles]) -> AssetLabels:
    asset, files = item
    try:
        mesh = files.read_mesh()
        given = label_mesh(name, mesh, vocabulary, str(files.path))
        return AssetLabels(asset, hull_digests(mesh), given, {hull: (name, hull) for hull in given})
    except Exception as error:  # an asset that fails never stops the others
        return AssetLabels(asset, error=describe_error(error, str(files.path)))


def label_mesh(name: str, mesh: SymbolicMesh, vocabulary: Sequence[str], where: str) -> dict[str, Label]:
    """Return the labels that a plug-in's labeler gives to hulls, by name; none by one that sees whole families only.

    where: the asset. Raises PluginError where it fails.
    """
    plugin, kind = LABELERS.plugin(name), LABELERS[name]
    if not issubclass(kind, AssetLabeler):
        return {}
    with blame(plugin, where):
        labels = dict(kind().label(mesh, vocabulary))
        if plugin and (problem := _find_wrong_label(labels)):
            raise plugin.error(problem, where)
        return {hull: replace(label, source="plugin", given=None) for hull, label in labels.items()}


def _find_wrong_label(labels: Mapping[Any, Any]) -> str | None:
    for hull, label in labels.items():
        if not isinstance(label, Label):
            return f"gave the hull {hull!r} a {type(label).__name__}, not a Label"
        if not (isinstance(label.name, str) and 0 <= label.confidence <= 1):
            return f"gave the hull {hull!r} the label {label.name!r} with the confidence {label.confidence!r}"
    return None
