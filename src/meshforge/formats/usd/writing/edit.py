"""An edit of a stage, authored into a copy of its root layer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from meshforge.asset import Asset, Geom
from meshforge.errors import AssetError
from meshforge.formats.mesh_parts import MeshPart
from meshforge.formats.usd.document import BODY, Authored, UsdDocument
from meshforge.formats.usd.reading.bodies import Bodies
from meshforge.formats.usd.reading.colliders import is_drawn
from meshforge.formats.usd.reading.read import Source
from meshforge.formats.usd.reading.stage import Scene
from meshforge.formats.usd.writing.inherited import inherit
from meshforge.formats.usd.writing.removing import free, take_collision
from meshforge.formats.usd.writing.specs import Space, collider, mesh, native, prim_name
from meshforge.words import counted

_GROUP = "collection:colliders:includes"


@dataclass(eq=False)
class Edit:
    """Edits a copy of a root layer; names: what hulls read back as that cannot have their own names; notes for people.

    changed: the bodies whose colliders are not what they were.
    """

    scene: Scene
    bodies: Bodies
    document: UsdDocument
    layer: Any
    names: dict[str, str] = field(default_factory=dict)
    changed: set[str] = field(default_factory=set)
    _how: Counter[str] = field(default_factory=Counter)
    _hulled: Counter[str] = field(default_factory=Counter)

    def run(self, asset: Asset, sources: Sequence[Source]) -> None:
        """Bring the layer to hold just the geoms and opaque pieces of an asset. Raises AssetError."""
        kept = {g.name for g in asset.geoms if g.parent is None} | {o.name for o in asset.opaque}
        for element, source in zip(self.document.authored, sources, strict=True):
            staying = [k for k, name in enumerate(element.names) if name in kept]
            if len(staying) < len(element.names):
                self._remove(element, source, staying)
        known = {name: k for k, element in enumerate(self.document.authored) for name in element.names}
        for geom in asset.geoms:
            if geom.parent is not None or geom.name not in known:
                parent = known.get(geom.parent or "")
                self._add_hull(geom, None if parent is None else sources[parent])

    @property
    def notes(self) -> list[str]:
        """How the edit is written where that is not obvious."""
        found = [
            f"{counted(number, kind)} written as hull meshes: USD has no such shape here"
            for kind, number in sorted(self._hulled.items())
        ]
        if number := self._how["deactivated"]:
            verb = "is" if number == 1 else "are"
            found.append(f"{counted(number, 'prim')} of other layers {verb} switched off (active = false), not removed")
        if number := self._how["stripped"]:
            verb = "stays" if number == 1 else "stay"
            found.append(f"{counted(number, 'prim')} {verb}, to be seen, and no longer collide")
        return found

    def _remove(self, element: Authored, source: Source, staying: Sequence[int]) -> None:
        """Take a prim's collision, and put the pieces that stay beside it."""
        if element.fixed:
            raise AssetError(f"hull {element.names[0]!r} cannot be changed: it {element.fixed}", where=self._where)
        self._how[take_collision(self.scene, self.layer, source.prim, self.document.physics)] += 1
        self.changed.add(element.body)
        for k in staying:
            self._keep_piece(element.names[k], element.body, source, source.parts[k])

    def _keep_piece(self, name: str, body: str, source: Source, part: MeshPart) -> None:
        shape = part.shape or part.surface
        if shape is None:
            raise AssetError(f"{name!r} cannot stay without the rest of its mesh", where=self._where)
        holder, space = self._find_holder(source, body)
        spec = mesh(holder, self._free_name(holder, name), np.asarray(shape.vertices), shape.faces, space)
        self._finish(spec, name, body, source, "convexHull" if part.shape else "none")

    def _add_hull(self, geom: Geom, parent: Source | None) -> None:
        """A new prim beside that of its parent, or below its body."""
        if parent is not None and parent.fixed:
            raise AssetError(f"hull {geom.name!r} takes after {parent.path}, which {parent.fixed}", where=self._where)
        holder, space = self._find_holder(parent, geom.body)
        wanted = self._free_name(holder, geom.name)
        spec, approximation = native(holder, wanted, geom.shape, space), None
        if spec is None:
            if geom.shape.is_primitive:
                self._hulled[geom.shape.kind] += 1
            spec = mesh(holder, wanted, np.asarray(geom.shape.vertices), geom.shape.faces, space)
            approximation = "convexHull"
        self._finish(spec, geom.name, geom.body, parent, approximation)
        self.changed.add(geom.body)

    def _finish(self, spec: Any, name: str, body: str, parent: Source | None, approximation: str | None) -> None:
        """Mark a new prim as collision, with what it inherits, and see what it will be called."""
        if self.document.physics:
            collider(spec, approximation, drawn=parent is not None and is_drawn(parent.prim))
            if parent is not None:
                inherit(spec, parent.prim)
                self._join_groups(parent.path, spec.path)
        read = self.bodies.hull_name(str(spec.path), body)
        if read != name:
            self.names[name] = read

    def _find_holder(self, parent: Source | None, body: str) -> tuple[Any, Space]:
        """The spec below which a new prim goes, and the space that it is put in."""
        from pxr import Sdf

        prim = self._find_holding_prim(parent, body)
        while not prim.IsPseudoRoot() and not _is_regular(self.scene, prim):
            prim = prim.GetParent()
        if prim.IsPseudoRoot():
            return self.layer.pseudoRoot, Space(self.scene.metres * np.eye(3), np.zeros(3))
        if prim.IsInstanceProxy() or prim.IsInstance():
            free(self.layer, prim)
            if prim.IsInstance():
                Sdf.CreatePrimInLayer(self.layer, prim.GetPath()).SetInfo("instanceable", False)
        return Sdf.CreatePrimInLayer(self.layer, prim.GetPath()), Space(*self.scene.placement(prim))

    def _find_holding_prim(self, parent: Source | None, body: str) -> Any:
        own = next((path for path, name in self.bodies.names.items() if name == body), None)
        if own is None and body != BODY:
            raise AssetError(f"there is no body {body!r} in the file", where=self._where)
        if parent is not None and parent.body == body:
            below = parent.path in (own, self.scene.base)
            return parent.prim if below else parent.prim.GetParent()
        if own is not None:
            return self.bodies.prims[own]
        return self.scene.stage.GetDefaultPrim() or self.scene.stage.GetPseudoRoot()

    def _free_name(self, holder: Any, name: str) -> str:
        """The name of a new prim: the last part of a hull's, free in the layer and in the stage."""
        prim = self.scene.stage.GetPrimAtPath(holder.path)
        taken = [child.GetName() for child in prim.GetAllChildren()] if prim else []
        return prim_name(name.rsplit("/", 1)[-1], [*taken, *(child.name for child in holder.nameChildren)])

    def _join_groups(self, parent: str, made: Any) -> None:
        """Make a new prim a member of the collision groups that name its parent."""
        from pxr import Sdf

        for group in self.scene.stage.Traverse():
            if group.GetTypeName() == "PhysicsCollisionGroup":
                targets = [str(target) for target in group.GetRelationship(_GROUP).GetTargets()]
                if parent in targets:
                    spec = Sdf.CreatePrimInLayer(self.layer, group.GetPath())
                    own = spec.relationships.get(_GROUP) or Sdf.RelationshipSpec(spec, _GROUP, False)
                    own.targetPathList.Append(made)

    @property
    def _where(self) -> str:
        return str(self.scene.path)


def _is_regular(scene: Scene, prim: Any) -> bool:
    """Whether what is put below a prim keeps its volume."""
    linear, offset = scene.placement(prim)
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return False
    stretch = np.linalg.svd(linear, compute_uv=False)
    return bool(stretch[-1] > 1e-9 * stretch[0])
