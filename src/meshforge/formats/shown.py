"""What the bodies of an asset show, as surfaces."""

from __future__ import annotations

from dataclasses import replace

from meshforge.asset import Asset, Surface, What
from meshforge.formats.losses import Loss
from meshforge.formats.visuals import Visual, visuals_of


def shown(asset: Asset) -> tuple[list[tuple[str, Surface]], list[Loss]]:
    """The surfaces of visuals with their bodies and colours, and what cannot be read."""
    found: list[tuple[str, Surface]] = []
    refused: list[str] = []
    for body, visual in visuals_of(asset):
        surfaces = visual.surfaces() if isinstance(visual, Visual) else [visual]
        found += [(body, replace(surface, rgba=visual.rgba)) for surface in surfaces if len(surface.faces)]
        if not surfaces:
            refused.append(body)
    names = tuple(dict.fromkeys(refused))
    return found, [Loss(What.VISUALS, names, "their files cannot be read")] if refused else []
