"""Labels out of files: labels files, segmented points and meshes, and what a dataset says of its links."""
