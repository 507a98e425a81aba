"""Writing an edited SDF: each authored file with other collision elements."""
