"""Labels found by machines: carried over from a few labelled assets to the rest of their family."""

from meshforge.perception.propagation import Propagated, propagate

__all__ = ["Propagated", "propagate"]
