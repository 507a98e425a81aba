"""The pictures of an asset, as data in the page."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch.report.asset import ReportAsset
from meshforge.symbolic import SymbolicMesh
from meshforge.views import ColorBy, compare, difference, render, webp

if TYPE_CHECKING:
    from PIL.Image import Image

SIZE = (600, 450)


@dataclass(frozen=True, slots=True)
class Manner:
    """How pictures are drawn.

    vocabulary: the order in which labels take their colours; by_label: whether hulls have those, else each its own;
    changes: whether with pictures of what became of each hull.
    """

    vocabulary: tuple[str, ...]
    by_label: bool
    changes: bool


@dataclass(frozen=True, slots=True)
class Pictures:
    """Addresses `data:…` of an asset's pictures; after and changes are None where nothing changed.

    blamed: whether hulls that findings name stand out in them.
    """

    before: str
    after: str | None = None
    changes: str | None = None
    has_blame: bool = False


def pictures(asset: ReportAsset, manner: Manner) -> Pictures | None:
    """The pictures of an asset, on transparent ground; None where there is no mesh to be seen."""
    before, after = asset.before, asset.after
    if before is None:
        return None
    color_by: ColorBy = "label" if manner.by_label else "hull"
    if after is None or after is before or asset.status == "unchanged" or not (before.hulls or after.hulls):
        blamed = _blamed(asset, before) if after is before else None
        image = render(
            before,
            color_by=color_by,
            size=SIZE,
            highlight=blamed,
            vocabulary=manner.vocabulary,
            background=None,
            legend=False,
        )
        return Pictures(address(image), has_blame=blamed is not None)
    pair = compare(before, after, color_by=color_by, size=SIZE, vocabulary=manner.vocabulary, background=None)
    changes = difference(before, after, size=SIZE, background=None, legend=False) if manner.changes else None
    return Pictures(address(pair[0]), address(pair[1]), address(changes) if changes else None)


def _blamed(asset: ReportAsset, mesh: SymbolicMesh) -> frozenset[str] | None:
    """The hulls that findings name, None where they name none that is there, or all: then none would stand out."""
    named = asset.hulls_to_blame & mesh.index.keys()
    return named if 0 < len(named) < len(mesh.hulls) else None


def address(image: Image) -> str:
    """A picture as an address `data:…` that holds it."""
    return f"data:image/webp;base64,{base64.b64encode(webp(image)).decode()}"
