"""Measures how a family comes to be signed off: what is right in it, and what a person is told of the rest."""
