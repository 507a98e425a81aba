"""What the demonstrations leave open: readings, how believable they are, and what to ask."""

from meshforge.synthesis.readings.every import every
from meshforge.synthesis.readings.weighed import Weighed

__all__ = ["Weighed", "every"]
