"""Mesh files as triangles: one reader for each kind, which know nothing of hulls."""

from meshforge.formats.meshfile.surface import FARTHEST, RawSurface, Soup, checked, joined

__all__ = ["FARTHEST", "RawSurface", "Soup", "checked", "joined"]
