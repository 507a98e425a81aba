"""Labels of one to five assets carried to all others of a family, offline, each with its chance."""

from meshforge.perception.propagation.propagate import Propagated, Relatives, given_label, propagate

__all__ = ["Propagated", "Relatives", "given_label", "propagate"]
