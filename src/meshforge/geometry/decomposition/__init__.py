"""Convex decomposition by CoACD or V-HACD, in a process of its own, with a cache."""
