"""Names of bodies and geoms in an MJCF that is made, such that they read back as those of the asset where they can."""

from __future__ import annotations

from collections import Counter

from meshforge.asset import Asset
from meshforge.formats.body_tree import BodyTree, free_name
from meshforge.formats.mjcf.document import geom_names

WORLD = "world"
"""What MuJoCo calls the body that never moves; no other may have this name."""


def new_body_names(tree: BodyTree) -> dict[str, str]:
    """What each body of an asset is called; a root called world is MuJoCo's, no other body is."""
    taken = {WORLD, *tree.order}
    is_root = WORLD in tree.roots
    return {name: free_name(name, taken) if name == WORLD and not is_root else name for name in tree.order}


def new_geom_names(asset: Asset, tree: BodyTree, bodies: dict[str, str]) -> dict[str, tuple[str, str]]:
    """For each hull and plane the name attribute, empty where it needs none, and the name that it reads back as.

    bodies: what the bodies of the tree are called.
    """
    pieces = [(geom.name, geom.body) for geom in asset.geoms]
    pieces += [(piece.name, piece.body) for piece in asset.opaque if piece.plane]
    ordered = [(name, own) for body in tree.order for name, own in pieces if own == body]
    plain = [name.removeprefix(f"{body}/") for name, body in ordered]
    holders = [bodies[body] for _, body in ordered]
    shared = Counter(plain)
    taken: set[str] = set()
    attributes = []
    for unnamed, holder, name in zip(geom_names([(h, "") for h in holders]), holders, plain, strict=True):
        wanted = f"{holder}/{name}" if shared[name] > 1 else name
        attributes.append("" if unnamed == f"{holder}/{name}" else free_name(wanted, taken))
    back = geom_names(list(zip(holders, attributes, strict=True)))
    return {name: pair for (name, _), pair in zip(ordered, zip(attributes, back, strict=True), strict=True)}
