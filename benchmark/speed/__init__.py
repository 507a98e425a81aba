"""How fast MeshForge is, against the libraries that people use today, on the same files in the same run."""
