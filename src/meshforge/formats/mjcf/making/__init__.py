"""An MJCF made of an asset that comes from another format."""
