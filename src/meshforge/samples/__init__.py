"""Families of assets to try MeshForge on; everything in them was made by our own code.

Tables are frozen files, decomposed by CoACD part by part, which `script/make-samples` makes again. Bottles, cups and
chairs are built when they are asked for, in about a second, with the same bytes each time: each is a row of numbers
(profiles, counts, cuts), and its convex pieces are built part by part (`pieces.py`), in number and shape as a
decomposition would have them. So every hull has the label of its part.
"""

from meshforge.samples.families import FAMILIES, TABLES, SampleFamily, family_of, write_family

__all__ = ["FAMILIES", "TABLES", "SampleFamily", "family_of", "write_family"]
