"""The pictures of an asset, as data in the page."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch.report.asset import ReportAsset
from meshforge.views import ColorBy, compare, difference, render, webp

if TYPE_CHECKING:
    from PIL.Image import Image

SIZE = (600, 450)


@dataclass(frozen=True, slots=True)
class Pictures:
    """Addresses `data:…` of an asset's pictures; after and changes are None where nothing changed."""

    before: str
    after: str | None = None
    changes: str | None = None


def pictures(asset: ReportAsset, vocabulary: Sequence[str]) -> Pictures | None:
    """The pictures of an asset, on transparent ground; None where there is no mesh to be seen."""
    before, after = asset.before, asset.after
    if before is None:
        return None
    labelled = any(h.label for mesh in (before, after) if mesh for h in mesh.hulls)
    color_by: ColorBy = "label" if labelled else "hull"
    if after is None or after is before or asset.status == "unchanged":
        image = render(before, color_by=color_by, size=SIZE, vocabulary=vocabulary, background=None, legend=False)
        return Pictures(address(image))
    pair = compare(before, after, color_by=color_by, size=SIZE, vocabulary=vocabulary, background=None)
    changes = difference(before, after, size=SIZE, background=None, legend=False)
    return Pictures(address(pair[0]), address(pair[1]), address(changes))


def address(image: Image) -> str:
    """A picture as an address `data:…` that holds it."""
    return f"data:image/webp;base64,{base64.b64encode(webp(image)).decode()}"
