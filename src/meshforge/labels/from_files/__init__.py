"""Labels out of files: labels files, segmented points, and what a dataset says of its links."""
