"""Families of assets to try MeshForge on; everything in them was made by our own code.

Tables are decomposed by CoACD part by part; `script/make-samples` makes them. Bottles, cups and chairs are rows of
numbers (profiles, counts, cuts), whose convex pieces are built part by part, in number and shape as a decomposition
would have them: `script/make-families`. So every hull has the label of its part.
"""

from meshforge.samples.families import FAMILIES, TABLES, SampleFamily, family_of, write_family

__all__ = ["FAMILIES", "TABLES", "SampleFamily", "family_of", "write_family"]
