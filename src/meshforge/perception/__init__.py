"""Labels found by machines: carried over from a few labelled assets to the rest of their family."""

from meshforge.perception.propagation import Propagated, Relatives, given_label, propagate

__all__ = ["Propagated", "Relatives", "given_label", "propagate"]
