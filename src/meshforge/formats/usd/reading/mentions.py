"""What a stage calls a prim that collides besides its path: by prims above it, semantic labels and materials."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from meshforge.asset import Mentions
from meshforge.formats.mentioned import without_repeats

_LABELS = "SemanticsLabelsAPI:"
_ISAAC = "SemanticsAPI:"


def prim_mentions(prim: Any) -> Mentions:
    """What is said of a prim with collision."""
    from pxr import UsdShade

    found = [("class", label) for each in (prim, prim.GetParent()) for label in _labels(each)]
    found += [("node", prim.GetName()), ("node", prim.GetParent().GetName())]
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    if material:
        found.append(("material", material.GetPrim().GetName()))
    return without_repeats(found)


def _labels(prim: Any) -> Iterator[str]:
    """The labels of a prim, by USD's own schema and by that of Isaac's earlier versions."""
    for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas():
        if schema.startswith(_LABELS):
            labels = prim.GetAttribute(f"semantics:labels:{schema.removeprefix(_LABELS)}").Get()
            yield from map(str, labels or ())
        elif schema.startswith(_ISAAC):
            data = prim.GetAttribute(f"semantic:{schema.removeprefix(_ISAAC)}:params:semanticData").Get()
            yield str(data or "")
