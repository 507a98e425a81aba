"""URDF: robots and articulated objects as links with collision elements; read, and written back losslessly."""
