"""What every file becomes: an asset of bodies and convex geoms, with its kept source document."""

from meshforge.asset.asset import Asset, Body, Document, Geom, Mentions, Opaque, Surface, unique_names
from meshforge.asset.features import PRIMITIVES, Feature, What, features
from meshforge.asset.mechanism import Inertial, Joint, JointKind, Mechanism, unit

__all__ = [
    "PRIMITIVES",
    "Asset",
    "Body",
    "Document",
    "Feature",
    "Geom",
    "Inertial",
    "Joint",
    "JointKind",
    "Mechanism",
    "Mentions",
    "Opaque",
    "Surface",
    "What",
    "features",
    "unique_names",
    "unit",
]
