"""Labels from labellers of plug-ins, asset by asset in worker processes, taken or only proposed."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial
from inspect import isabstract
from typing import Any

from meshforge.batch import ExecutionOptions, WorkerFailure, execute
from meshforge.common import Plugin, ProjectError, Registry, UsageError, blame, describe_error, suggest_among
from meshforge.labels.merge import LabelOutcome, LabelWriter, OutcomeCallback, can_replace_less_certain, merge_labels
from meshforge.labels.summary import LabelEvidence, Proposals, group_evidence
from meshforge.store import AssetFiles, Store, hull_digests
from meshforge.symbolic import Label, SymbolicMesh

LABEL_METHODS = ("file", "names", "propagate", "vlm", "consensus", "sources")
"""What `label --with` takes without plug-ins."""


class AssetLabeler(ABC):
    """A labeller that a plug-in adds; it is made anew for each asset, without arguments."""

    @abstractmethod
    def label(self, mesh: SymbolicMesh, vocabulary: Sequence[str]) -> Mapping[str, Label]:
        """Labels out of the vocabulary by the names of hulls, each with its confidence in 0..1.

        Hulls of which it says nothing are left out. The source of the labels is set to `plugin`.
        """


def _adopt(plugin: Plugin, kind: Any) -> type[AssetLabeler]:
    """The class of a plug-in's labeller. Raises PluginError where it does not fit."""
    if not (isinstance(kind, type) and issubclass(kind, AssetLabeler)):
        raise plugin.error("does not fit: it is no subclass of meshforge.labels.AssetLabeler")
    if isabstract(kind):
        raise plugin.error("does not fit: it has no method label")
    return kind


LABELERS: Registry[type[AssetLabeler]] = Registry("labelers", {}, _adopt, reserved=LABEL_METHODS)
"""The labellers of plug-ins, by what `label --with` takes."""


def check_labeler(name: str) -> None:
    """Raise UsageError for a labeller that is not known, PluginError for one that cannot be loaded."""
    if name not in LABEL_METHODS and LABELERS.get(name) is None:
        known = (*LABEL_METHODS, *LABELERS)
        raise UsageError(f"there are no labels from {name!r}", remedy=suggest_among(name, known, "--with takes"))


@dataclass(frozen=True, slots=True)
class _AssetLabels:
    """What a labeller says about an asset. hulls: digests by name, in order; current: the labels there are.

    error: why it says nothing.
    """

    hulls: Mapping[str, str] = field(default_factory=dict)
    current: Mapping[str, Label] = field(default_factory=dict)
    given: Mapping[str, Label] = field(default_factory=dict)
    error: str | None = None


def label_by_plugin(
    store: Store, name: str, execution: ExecutionOptions, report: OutcomeCallback
) -> tuple[LabelOutcome, ...]:
    """Give labels to hulls that have none, or a less certain one of a machine; see `LabelStore.label_by_plugin`."""
    writer, reports = LabelWriter(store), list[LabelOutcome]()
    with closing(_label_assets(store, name, store.vocabulary, execution)) as results:
        for asset, found in results:
            if found.error:
                outcome = LabelOutcome(asset, problems=(found.error,))
            else:
                outcome = writer.try_write(asset, found.hulls, found.given, can_replace_less_certain)
            reports.append(outcome)
            report(outcome)
    return tuple(reports)


def propose_by_plugin(
    store: Store, name: str, vocabulary: Sequence[str] | None, execution: ExecutionOptions
) -> Proposals:
    """What `label_by_plugin` would write, with nothing written."""
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    evidence, problems, labelled = list[LabelEvidence](), list[str](), 0
    with closing(_label_assets(store, name, words, execution)) as results:
        for asset, found in results:
            may = {
                hull: one for hull, one in found.given.items() if can_replace_less_certain(found.current.get(hull), one)
            }
            labels, outcome = merge_labels(asset, found.hulls, found.current, may, words)
            taken = [hull for hull in labels if labels[hull] != found.current.get(hull)]
            evidence += [LabelEvidence(asset, labels[hull], name, hull) for hull in taken]
            evidence += [LabelEvidence(asset, None, "nothing said", hull) for hull in found.hulls if hull not in labels]
            problems += [f"{asset}: {why}" for why in (*([found.error] if found.error else []), *outcome.problems)]
            labelled += len(labels) - len(taken)
    return group_evidence(evidence, words, labelled, problems)


def _label_assets(
    store: Store, name: str, vocabulary: Sequence[str], execution: ExecutionOptions
) -> Generator[tuple[str, _AssetLabels], None, None]:
    """What a labeller says about each asset, in their order. Raises ProjectError: no vocabulary."""
    check_labeler(name)
    if not vocabulary:
        remedy = "Say first what hulls can be: --vocabulary a,b,c."
        raise ProjectError("the vocabulary is empty", where=str(store.folder), remedy=remedy)
    assets = store.assets()
    with closing(execute(partial(_label_asset, name, tuple(vocabulary)), store.asset_files(assets), execution)) as work:
        for asset, found in zip(assets, work, strict=True):
            if isinstance(found, WorkerFailure):
                found = _AssetLabels(error=f"{store.path(asset)}: {found.why}")
            yield asset, found


def _label_asset(name: str, vocabulary: tuple[str, ...], files: AssetFiles) -> _AssetLabels:
    try:
        mesh = files.read_mesh()
        return _AssetLabels(hull_digests(mesh), mesh.labels, ask_labeler(name, mesh, vocabulary, str(files.path)))
    except Exception as error:  # an asset that fails never stops the others
        return _AssetLabels(error=describe_error(error, str(files.path)))


def ask_labeler(name: str, mesh: SymbolicMesh, vocabulary: Sequence[str], where: str) -> dict[str, Label]:
    """The labels that a labeller gives to hulls, by name; where: the asset. Raises PluginError where it fails."""
    plugin, kind = LABELERS.plugin(name), LABELERS[name]
    with blame(plugin, where):
        said = dict(kind().label(mesh, vocabulary))
        if plugin and (problem := _find_odd_label(said)):
            raise plugin.error(problem, where)
        return {hull: replace(label, source="plugin", given=None) for hull, label in said.items()}


def _find_odd_label(said: Mapping[Any, Any]) -> str | None:
    """What is wrong with the first thing that is no label of a hull; None where all are."""
    for hull, label in said.items():
        if not isinstance(label, Label):
            return f"gave the hull {hull!r} a {type(label).__name__}, not a Label"
        if not (isinstance(label.name, str) and 0 <= label.confidence <= 1):
            return f"gave the hull {hull!r} the label {label.name!r} with the confidence {label.confidence!r}"
    return None
