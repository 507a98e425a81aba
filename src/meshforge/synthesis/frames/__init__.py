"""Common frames: the landmark pairs that would make demonstrations in different frames consistent."""

from meshforge.synthesis.frames.suggest import Suggested, suggest_orientation

__all__ = ["Suggested", "suggest_orientation"]
