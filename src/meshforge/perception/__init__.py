"""Labels found by machines: carried over from a few labelled assets, read off names and points, asked of a model."""

from meshforge.perception.propagation import Propagated, Relatives, given_label, propagate

__all__ = ["Propagated", "Relatives", "given_label", "propagate"]
