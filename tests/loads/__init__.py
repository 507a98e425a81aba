"""Written files of every format as other programs load them: as many collision shapes, where MeshForge has them."""
