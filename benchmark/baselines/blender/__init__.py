"""Runs scripts that a model wrote in headless Blender: confined, by the clock, and only legal hulls come back."""
