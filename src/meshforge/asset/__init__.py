"""What every file becomes: an asset of bodies and convex geoms, with its kept source document."""

from meshforge.asset.asset import Asset, Body, Document, Geom, Opaque, Surface, unique_names

__all__ = ["Asset", "Body", "Document", "Geom", "Opaque", "Surface", "unique_names"]
