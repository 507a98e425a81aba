"""The editing actions: one base, one file an action, one line each in the registry."""
