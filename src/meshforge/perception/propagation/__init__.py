"""Labels of one to five assets carried to all others of a family, offline, each with its chance."""

from meshforge.perception.propagation.propagate import Propagated, propagate

__all__ = ["Propagated", "propagate"]
