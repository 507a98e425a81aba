"""Measures how learning does: families to learn on, hidden programs, and what is asked on the way."""
