"""Which hulls were found to span parts, when the project was looked at last; and which a person said do not."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from pydantic import Field

from meshforge.geometry import PieceEngine
from meshforge.store.layout import JsonFile

MOST_TOLD = 0.99
"""What is told of a label that follows from others, at most: 100% reads as certain."""


class SpanPart(JsonFile):
    """One part of a hull. label: its likeliest; share: of that label in what the part stands for."""

    label: str
    share: float


class SpanLine(JsonFile):
    """One hull that likely spans parts. geometry: the digest of the hull as it was; told: in words; parts: what a split
    makes of it, none where no plane divides it; pieces: the engine of the fine pieces that say so.
    """

    geometry: str
    chance: float
    told: str
    parts: tuple[SpanPart, ...] = ()
    pieces: PieceEngine = "coacd"

    @property
    def parts_told(self) -> str:
        """The parts in words."""
        return describe_parts((part.label, part.share) for part in self.parts)


class SpansFile(JsonFile):
    """.meshforge/spans.json: likely hulls, by asset and name."""

    assets: dict[str, dict[str, SpanLine]] = Field(default_factory=dict)

    def likely(self, asset: str, hulls: Mapping[str, str]) -> dict[str, SpanLine]:
        """Those of an asset whose geometry is what it was; hulls: their digests by name."""
        return {name: line for name, line in self.assets.get(asset, {}).items() if hulls.get(name) == line.geometry}

    def without(self, single: SinglePartsFile) -> SpansFile:
        """The same but for hulls that a person said to be one part."""
        rows = {
            asset: {name: line for name, line in lines.items() if not single.holds(asset, name, line.geometry)}
            for asset, lines in self.assets.items()
        }
        return self.model_copy(update={"assets": {asset: lines for asset, lines in rows.items() if lines}})


class SinglePartsFile(JsonFile):
    """single_parts.json: hulls that a person said to be one part, each with its digest, by asset and name."""

    assets: dict[str, dict[str, str]] = Field(default_factory=dict)

    def holds(self, asset: str, hull: str, geometry: str) -> bool:
        """Whether that was said of a hull of this geometry."""
        return self.assets.get(asset, {}).get(hull) == geometry

    def with_hull(self, asset: str, hull: str, geometry: str) -> SinglePartsFile:
        """The same, and one hull more."""
        rows = {**self.assets, asset: dict(sorted({**self.assets.get(asset, {}), hull: geometry}.items()))}
        return self.model_copy(update={"assets": dict(sorted(rows.items()))})


def describe_parts(parts: Iterable[tuple[str, float | None]]) -> str:
    """Labels of parts with their shares, or how sure they are, where that is known: `10 wall (75% to 92%), handle`."""
    shares = dict[str, list[float | None]]()
    for label, share in parts:
        shares.setdefault(label, []).append(share)
    words = []
    for label, own in shares.items():
        known = [min(share, MOST_TOLD) for share in own if share is not None]
        ends = dict.fromkeys(f"{share:.0%}" for share in (min(known), max(known))) if known else ()
        told = f" ({' to '.join(ends)})" if ends else ""
        words.append(f"{f'{len(own)} ' if len(own) > 1 else ''}{label}{told}")
    return ", ".join(words)
