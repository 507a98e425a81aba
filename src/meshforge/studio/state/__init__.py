"""The state of an open studio, and all that keeps it in step with the project's files; its door: `Desk`."""

from meshforge.studio.state.desk import Desk, Opening

__all__ = ["Desk", "Opening"]
