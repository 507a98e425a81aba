"""A stage of an asset of another format."""
