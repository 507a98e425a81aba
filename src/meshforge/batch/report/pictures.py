"""The pictures of one asset on the page, as addresses that hold them."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch.report.contents import ReportAsset
from meshforge.checks import Examination, draw_examination
from meshforge.rendering import ColorBy, compare, draw_difference, encode_webp, render
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

PICTURE_SIZE = (600, 450)
CHECK_PICTURE_SIZE = (420, 315)


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """How pictures are drawn.

    vocabulary: the order in which labels take their colours; by_label: whether hulls have those, else each its own;
    changes: whether to draw what became of each hull.
    """

    vocabulary: tuple[str, ...]
    by_label: bool
    changes: bool


@dataclass(frozen=True, slots=True)
class AssetPictures:
    """Addresses `data:…` of an asset's pictures; after and changes are None where nothing changed.

    has_blame: whether hulls that findings name stand out in them; checks: what pictures of checks show, and these.
    """

    before: str
    after: str | None = None
    changes: str | None = None
    has_blame: bool = False
    checks: tuple[tuple[str, str], ...] = ()


def draw_asset(asset: ReportAsset, options: PictureOptions) -> AssetPictures | None:
    """The pictures of an asset, on transparent ground; None where there is no mesh to be seen."""
    before, after = asset.before, asset.after
    if before is None:
        return None
    color_by: ColorBy = "label" if options.by_label else "hull"
    checks = _draw_checks(asset, after or before)
    if after is None or after is before or asset.status == "unchanged" or not (before.hulls or after.hulls):
        blamed = _find_hulls_to_blame(asset, before) if after is before else None
        image = render(
            before,
            color_by=color_by,
            size=PICTURE_SIZE,
            highlight=blamed,
            vocabulary=options.vocabulary,
            background=None,
            legend=False,
        )
        return AssetPictures(_to_data_url(image), has_blame=blamed is not None, checks=checks)
    pair = compare(before, after, color_by=color_by, size=PICTURE_SIZE, vocabulary=options.vocabulary, background=None)
    changes = None
    if options.changes:
        changes = _to_data_url(draw_difference(before, after, size=PICTURE_SIZE, background=None, legend=False))
    return AssetPictures(_to_data_url(pair[0]), _to_data_url(pair[1]), changes, checks=checks)


def _find_hulls_to_blame(asset: ReportAsset, mesh: SymbolicMesh) -> frozenset[str] | None:
    """The hulls that findings name, None where they name none that is there, or all: then none would stand out."""
    named = asset.hulls_to_blame & mesh.index.keys()
    return named if 0 < len(named) < len(mesh.hulls) else None


def _draw_checks(asset: ReportAsset, mesh: SymbolicMesh) -> tuple[tuple[str, str], ...]:
    if not isinstance(asset.checked, Examination):
        return ()
    drawn = draw_examination(mesh, asset.checked, CHECK_PICTURE_SIZE)
    return tuple((words, _to_data_url(image)) for _, words, image in drawn)


def _to_data_url(image: Image) -> str:
    return f"data:image/webp;base64,{base64.b64encode(encode_webp(image)).decode()}"
