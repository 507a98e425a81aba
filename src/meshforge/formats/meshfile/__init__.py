"""Mesh files as triangles: one reader for each kind, which know nothing of hulls."""

from meshforge.formats.meshfile.surface import RawSurface, checked

__all__ = ["RawSurface", "checked"]
