"""glTF 2.0 and GLB: scenes with collision nodes, read, and written back with all else as it was."""
