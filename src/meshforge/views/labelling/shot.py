"""One picture of a mesh for naming its parts, with what it tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL.Image import Image


@dataclass(frozen=True, eq=False, slots=True)
class Shot:
    """One view of a mesh, for a model or a person to name its parts in.

    name: what is seen, in words, such as "front" or "hull 7 alone, from the front right, above".
    marked: each hull in its own colour, edges drawn, its number on it or beside it at the end of a line.
    plain: the same camera and size without words: the visual mesh where the asset has one, else the hulls in one
    material.
    seen: how many pixels of `marked` show each hull, by name, 0 for hidden ones and those drawn faintly; what is
    written over the drawing is not taken off.
    numbered: the hulls whose number stands on `marked`.
    """

    name: str
    marked: Image
    plain: Image
    visible_pixels: Mapping[str, int]
    numbered: frozenset[str]
