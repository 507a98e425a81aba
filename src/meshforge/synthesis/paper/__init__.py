"""The algorithms of the paper as printed, the yardstick: a worklist of partial programs, and abductive inference."""

from meshforge.synthesis.paper.search import Explained, paper_search

__all__ = ["Explained", "paper_search"]
