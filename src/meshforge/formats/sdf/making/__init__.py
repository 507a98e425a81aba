"""Making an SDF of an asset of another format."""
