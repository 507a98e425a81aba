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

    @property
    def reverse(self) -> Correction | None:
        """The correction that undoes this one, None where the hull had no label."""
        return None if self.was is None else Correction(self.asset, self.hull, self.to, self.was)
