"""From an asset of another format to a new scene: with colliders of an extension, plain, or named for an engine."""
