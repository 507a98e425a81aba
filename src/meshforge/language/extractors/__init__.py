"""The extractors: one base, one file for each leaf, one line each in the registry."""
