"""Which hulls were found to span parts, when the project was looked at last."""

from __future__ import annotations

from pydantic import Field

from meshforge.store.layout import JsonFile


class SpanLine(JsonFile):
    """One hull that likely spans parts. geometry: the digest of the hull as it was; told: in words."""

    geometry: str
    chance: float
    told: str


class SpansFile(JsonFile):
    """.meshforge/spans.json: likely hulls, by asset and name."""

    assets: dict[str, dict[str, SpanLine]] = Field(default_factory=dict)

    def likely(self, asset: str, hulls: dict[str, str]) -> dict[str, SpanLine]:
        """Those of an asset whose geometry is what it was; hulls: their digests by name."""
        return {name: line for name, line in self.assets.get(asset, {}).items() if hulls.get(name) == line.geometry}
