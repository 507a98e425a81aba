"""URDF: robots and articulated objects as links with collision elements; read, and written back losslessly."""

from meshforge.formats.urdf.urdf import UrdfFormat

__all__ = ["UrdfFormat"]
