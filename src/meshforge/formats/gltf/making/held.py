"""What a made glTF file holds of an asset, and what such files could hold besides."""

from __future__ import annotations

from meshforge.asset import What

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.CAPSULES,
        What.OPAQUE,
        What.PLANES,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset(
    {
        What.JOINTS,
        What.BALL_JOINTS,
        What.FIXED_JOINTS,
        What.MATERIALS,
        What.VERTEX_COLORS,
        What.TEXTURES,
        What.TEXTURE_COORDINATES,
        What.CONTACT,
        What.PAIRS,
        What.CAMERAS,
        What.LIGHTS,
        What.ANIMATIONS,
        What.SKINS,
    }
)
COULD_NAMED = COULD - {What.JOINTS, What.BALL_JOINTS, What.FIXED_JOINTS, What.CONTACT, What.PAIRS}
"""Those of them that are no physics, which names do not tell."""
