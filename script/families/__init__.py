"""Generators of the sample families of bottles, cups and chairs."""
