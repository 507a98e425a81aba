"""Checks of many assets: what is found of each, kept as it comes, and mended files."""
