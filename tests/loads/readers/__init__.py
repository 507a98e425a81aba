"""The readers, one module each; a module imports its program only when that is to read."""

from tests.loads.readers import bpy, drake, mujoco, newton, pybullet, sapien, trimesh, usd, yourdfpy
from tests.loads.readers.base import DIRECTIONS, Grain, Reader, Seen

READERS: dict[str, Reader] = {
    module.__name__.rpartition(".")[2]: module.READER
    for module in (mujoco, pybullet, sapien, newton, drake, usd, trimesh, yourdfpy, bpy)
}
"""By the names that the command line has for them."""

__all__ = ["DIRECTIONS", "READERS", "Grain", "Reader", "Seen"]
