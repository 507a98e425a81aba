"""What every file becomes: an asset of bodies and convex geoms, with its kept source document."""

from meshforge.asset.asset import Asset, Body, Document, Geom, Opaque, Surface, unique_names
from meshforge.asset.mechanism import Inertial, Joint, JointKind, Mechanism, unit

__all__ = [
    "Asset",
    "Body",
    "Document",
    "Geom",
    "Inertial",
    "Joint",
    "JointKind",
    "Mechanism",
    "Opaque",
    "Surface",
    "unique_names",
    "unit",
]
