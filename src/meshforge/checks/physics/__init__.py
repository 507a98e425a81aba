"""How an asset behaves in a physics engine: MuJoCo rests it on a plane."""

from meshforge.checks.physics.masses import masses
from meshforge.checks.physics.physics import Physics, physics

__all__ = ["Physics", "masses", "physics"]
