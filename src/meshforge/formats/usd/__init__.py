"""USD: stages as text, crate or package, with the physics schemas of OpenUSD."""

from meshforge.formats.usd.usd import UsdFormat

__all__ = ["UsdFormat"]
