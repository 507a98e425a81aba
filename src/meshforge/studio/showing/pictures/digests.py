"""Digests of all that decides how something is drawn, by which pages keep its picture for ever."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.batch import software, text_digest
from meshforge.symbolic import Label

_DRAWING = "1"
"""Counts the ways in which thumbnails were drawn."""


def picture_digest(geometry: str, labels: Iterable[Label | None], orient: str) -> str:
    """A digest of all that decides how an asset is drawn: its hulls, and labels that turn it.

    geometry: as of AssetStatus; labels: of its hulls in order; orient: the orientation's text.
    """
    landmarks = [label.name if label and label.name in orient else "" for label in labels]
    return text_digest("\n".join([_DRAWING, software(), geometry, orient, *landmarks]))


def edited_digest(picture: str, output: str) -> str:
    """The same of an output; picture: of the asset, which is turned alike; output: the digest of its files."""
    return text_digest(f"{picture} {output}")
