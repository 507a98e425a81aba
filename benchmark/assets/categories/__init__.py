"""The eight generators, a file each: `LABELS`, `KINDS`, `RARE` and `build`."""
