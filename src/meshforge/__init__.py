"""MeshForge: teach one collision mesh, mend the whole family."""
