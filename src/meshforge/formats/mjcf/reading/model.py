"""What MuJoCo compiled, in MeshForge's words: bodies in the root frame, and whose element each geom is."""

from __future__ import annotations

from functools import cached_property

from meshforge.asset import Geom, Opaque
from meshforge.formats.mjcf.document import Authored, MjcfBody, body_names, geom_names
from meshforge.formats.mjcf.files.flat import Flat
from meshforge.formats.mjcf.files.sources import Tree
from meshforge.formats.mjcf.reading.contact import contact_attributes
from meshforge.formats.mjcf.reading.engine import Compiled
from meshforge.formats.mjcf.reading.kinematics import body_poses, geom_poses, rotation_of
from meshforge.formats.mjcf.reading.mentions import GeomMentions
from meshforge.formats.mjcf.reading.shapes import Shapes
from meshforge.geometry import Pose

_INSIDE = {
    "replicate": "it is inside a <replicate>, which makes several geoms of one element",
    "frame": "it is inside a <frame> that scales what it holds",
}
_ATTACHED = "it comes out of another model, which is attached"


class Reading:
    """The compiled model and the elements it was made of.

    elements: of each geom, None for one out of another model. collides: whether each geom takes part in collisions, by
    its contact bits or by a `<pair>`. unweighed: the numbers of bodies of which some mass is not known.
    """

    def __init__(self, tree: Tree, flat: Flat, made: Compiled, unweighed: frozenset[int] = frozenset()) -> None:
        self.tree, self.flat, self.model, self.unweighed = tree, flat, made.model, unweighed
        self.spec_bodies, self.spec_geoms = made.bodies, made.geoms
        self.body_names = body_names([body.name for body in made.bodies])
        self.body_of = [self.body_names[k] for k in self.model.geom_bodyid]
        self.names = geom_names([(b, geom.name) for b, geom in zip(self.body_of, made.geoms, strict=True)])
        self.elements = [flat.node_at(geom.info) for geom in made.geoms]
        self.collides = self._find_colliding()
        self.body_poses = body_poses(self.model)
        self.geom_poses = geom_poses(self.model, self.body_poses)

    def read_pieces(self) -> tuple[tuple[Geom, ...], tuple[Opaque, ...]]:
        """The hulls, and the collision geometry that is none."""
        import mujoco

        geoms, opaque = [], []
        shapes, said = Shapes(self.model), GeomMentions(self.spec_geoms, self.body_of, self.collides)
        for k, (name, body, pose) in enumerate(zip(self.names, self.body_of, self.geom_poses, strict=True)):
            if not self.collides[k]:
                continue
            part = shapes.part_of(k, pose)
            if part.shape is not None:
                contact = contact_attributes(self.model, k)
                geoms.append(Geom(name, body, part.shape, contact=contact, mentions=said.of(k)))
            else:
                plane = pose if self.model.geom_type[k] == mujoco.mjtGeom.mjGEOM_PLANE else None
                opaque.append(Opaque(name, body, part.reason, part.surface, plane, said.of(k)))
        return tuple(geoms), tuple(opaque)

    @cached_property
    def bodies(self) -> tuple[MjcfBody, ...]:
        """The bodies in MuJoCo's order, the world first."""
        return tuple(self._read_body(k) for k in range(self.model.nbody))

    def _read_body(self, k: int) -> MjcfBody:
        model, body = self.model, self.spec_bodies[k]
        node = self.flat.node_at(body.info)
        return MjcfBody(
            name=self.body_names[k],
            parent=self.body_names[int(model.body_parentid[k])] if k else None,
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            pose=self.body_poses[k],
            inertial=Pose(rotation_of(model.body_iquat[k]), model.body_ipos[k]),
            mass=float(model.body_mass[k]),
            inertia=model.body_inertia[k].copy(),
            explicit=bool(body.explicitinertial),
        )

    def geom_records(self) -> tuple[Authored, ...]:
        """The elements that geoms were made of, in document order; geoms without one each for itself, at the end."""
        order = {id(node): k for k, node in enumerate(self.flat.nodes)}
        copies: dict[int, list[int]] = {}
        for k, node in enumerate(self.elements):
            copies.setdefault(len(order) + k if node is None else order[id(node)], []).append(k)
        inside = self._reasons_against_edit()
        return tuple(self._record_geom(copies[key], inside) for key in sorted(copies))

    def _reasons_against_edit(self) -> dict[int, str]:
        """Why what stands inside some elements cannot be edited, by the identity of its nodes."""
        found: dict[int, str] = {}
        for top in self.flat.nodes:
            if top.tag == "replicate" or (top.tag == "frame" and "scale" in top.attributes):
                found |= {id(node): _INSIDE[top.tag] for node in top.walk() if id(node) not in found}
        return found

    def _record_geom(self, copies: list[int], inside: dict[int, str]) -> Authored:
        node = self.elements[copies[0]]
        fixed = _ATTACHED if node is None else inside.get(id(node), "")
        return Authored(
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            body=self.body_of[copies[0]],
            names=tuple(self.names[k] for k in copies),
            collides=any(self.collides[k] for k in copies),
            fixed=fixed,
        )

    def _find_colliding(self) -> list[bool]:
        touching = (self.model.geom_contype != 0) | (self.model.geom_conaffinity != 0)
        touching[self.model.pair_geom1] = True
        touching[self.model.pair_geom2] = True
        return [bool(t) for t in touching]
