"""Mending what is beyond an engine's limits, as far as that is safe."""

from meshforge.checks.fixing.fix import Change, Fixed, fix

__all__ = ["Change", "Fixed", "fix"]
