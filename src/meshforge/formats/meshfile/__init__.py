"""Mesh files as triangles: one reader for each kind, which know nothing of hulls."""
