"""A `Usd.Stage` that is open in memory: its file where that says it all, else the stage as it is, flattened."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from meshforge.common.processes import call_isolated
from meshforge.formats.libraries import make_folder
from meshforge.formats.usd.stage import usd
from meshforge.symbolic import Asset, FileNote

_FLAT = FileNote("read from a stage that differs from its files: flattened into one layer, which is what gets edited")


@runtime_checkable
class StageObject(Protocol):
    """A `Usd.Stage`."""

    def GetRootLayer(self) -> Any:  # noqa: N802
        """Its root layer."""

    def GetUsedLayers(self) -> Any:  # noqa: N802
        """All its layers."""

    def GetSessionLayer(self) -> Any:  # noqa: N802
        """The layer of what is changed for this session only."""

    def Flatten(self) -> Any:  # noqa: N802
        """All of it in one layer."""


def read_stage(stage: StageObject) -> Asset:
    """The asset in a stage.

    A stage as its saved files have it is read from these, so that an edit keeps all the rest of them. One that is made
    in memory, or has unsaved changes, is flattened, references resolved, in a folder that lasts as long as the process.
    Raises AssetError as reading a file does.
    """
    from meshforge.formats.usd.read import read_usd  # lazy: only USD needs it

    root = stage.GetRootLayer()
    name = Path(str(root.GetDisplayName() or "stage")).stem or "stage"
    with usd(name):
        if _is_saved(stage):
            path, flat = Path(str(root.realPath)), False
        else:
            path, flat = make_folder() / f"{name}.usda", True
            stage.Flatten().Export(str(path))
    asset = call_isolated(read_usd, path, where=str(path))
    return replace(asset, notes=(_FLAT, *asset.notes)) if flat else asset


def _is_saved(stage: StageObject) -> bool:
    session = stage.GetSessionLayer()
    layers = [layer for layer in stage.GetUsedLayers() if layer != session]
    is_pure = session is None or session.empty
    return is_pure and all(layer.realPath and not layer.dirty and Path(layer.realPath).is_file() for layer in layers)
