"""The paper's baselines: a model that writes a program in the language, and one that writes a Blender script."""
