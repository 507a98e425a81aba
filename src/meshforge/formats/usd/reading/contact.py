"""What decides how a prim collides, besides its shape: attributes of the physics schemas, and its physics material."""

from __future__ import annotations

from typing import Any

_SCHEMAS = ("physxcollision", "physxconvexhull", "newton", "mjc")
_MATERIAL = "material:binding:physics"


def contact_attributes(prim: Any) -> tuple[tuple[str, str], ...]:
    """Names and values of what is authored on a prim, its physics material by path, in order of name."""
    found = {}
    for attribute in prim.GetAuthoredAttributes():
        name = attribute.GetName()
        if name.lower().startswith(_SCHEMAS) and attribute.Get() is not None:
            found[name] = str(attribute.Get())
    material = physics_material(prim)
    if material:
        found[_MATERIAL] = str(material.GetPath())
    return tuple(sorted(found.items()))


def physics_material(prim: Any) -> Any:
    """The material that a prim is bound to for physics, itself or from above; None where it is bound to none."""
    from pxr import UsdShade

    material, relationship = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
    return material.GetPrim() if material and relationship else None
