"""The labelers by what `label --with` takes: those that are built in, one line each, and those of plug-ins."""

from __future__ import annotations

from inspect import isabstract
from typing import Any

from meshforge.common import Plugin, Registry, UsageError, suggest_among
from meshforge.labels.from_files.label_by_files import FileLabeler
from meshforge.labels.label_by_consensus import ConsensusLabeler, SourceRestorer
from meshforge.labels.label_by_propagation import PropagationLabeler
from meshforge.labels.labeler import Labeler
from meshforge.labels.names.label_by_names import NameLabeler
from meshforge.labels.vlm.label_by_vlm import VlmLabeler

_BUILT_IN: tuple[type[Labeler], ...] = (
    FileLabeler,
    NameLabeler,
    PropagationLabeler,
    VlmLabeler,
    ConsensusLabeler,
    SourceRestorer,
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
    """A labeler without options. Raises UsageError: not known; PluginError: it cannot be loaded."""
    if name not in LABELERS:
        raise UsageError(f"there are no labels from {name!r}", remedy=suggest_among(name, LABELERS, "--with takes"))
    labeler = LABELERS[name]()
    labeler.name = name
    return labeler
