"""The names by which game engines know collision: Unreal by prefix, Godot by suffix, Unity by scripts of one's own."""

from meshforge.formats.naming.base import EngineNames, Names

__all__ = ["EngineNames", "Names"]
