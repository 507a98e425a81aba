"""Labels out of files: labels files and segmented points."""
