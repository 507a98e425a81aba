"""Triangle soups taken apart into their connected pieces, each judged: a convex hull, or opaque with the reason."""

from meshforge.geometry.pieces.piece import Piece, pieces
from meshforge.geometry.pieces.solidity import FILLED

__all__ = ["FILLED", "Piece", "pieces"]
