"""Hulls that span parts: how many are found, what splitting them gives, and what it costs."""
