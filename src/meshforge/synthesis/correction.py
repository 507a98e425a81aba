"""A label that may be wrong, and what it would be right to say."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Correction:
    """One hull of a demonstrated mesh gets another label; was: None where it has none.

    asset: how messages call the mesh.
    """

    asset: str
    hull: str
    was: str | None
    to: str
