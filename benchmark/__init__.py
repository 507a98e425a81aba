"""Measurements of MeshForge, with their results."""
