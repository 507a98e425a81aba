"""What MuJoCo compiled, in MeshForge's words: bodies in the root frame, and whose element each geom is."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from meshforge.asset import Geom, Opaque
from meshforge.formats.mjcf.document import Authored, MjcfBody, body_names, geom_names
from meshforge.formats.mjcf.engine import Compiled
from meshforge.formats.mjcf.flat import Flat
from meshforge.formats.mjcf.shapes import part_of
from meshforge.formats.mjcf.sources import Node
from meshforge.geometry import Floats, Pose

_MANY = {"replicate": "it is made by <replicate>", "flexcomp": "it is part of a <flexcomp>"}


class Reading:
    """The compiled model and the elements it was made of."""

    def __init__(self, flat: Flat, made: Compiled) -> None:
        import mujoco

        self.flat, self.made = flat, made
        self.model, self.spec = made.model, made.spec
        self.data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, self.data)
        bodies = {body.id: body for body in self.spec.bodies}
        geoms = {geom.id: geom for geom in self.spec.geoms}
        self.spec_bodies = [bodies[k] for k in range(self.model.nbody)]
        self.spec_geoms = [geoms[k] for k in range(self.model.ngeom)]
        self.geom_body = self.model.geom_bodyid.tolist()
        self.elements = [flat.node(geom.info) for geom in self.spec_geoms]

    @cached_property
    def bodies(self) -> tuple[MjcfBody, ...]:
        return tuple(self._body(k, names) for names in [self._body_names] for k in range(self.model.nbody))

    @cached_property
    def names(self) -> list[str]:
        """What each geom is called."""
        bodies = self._body_names
        return geom_names(
            [(bodies[body], geom.name) for body, geom in zip(self.geom_body, self.spec_geoms, strict=True)]
        )

    @cached_property
    def collides(self) -> list[bool]:
        """Whether each geom takes part in collisions, by its contact bits or by a `<pair>`."""
        by_bits = (self.model.geom_contype != 0) | (self.model.geom_conaffinity != 0)
        by_bits[self.model.pair_geom1] = True
        by_bits[self.model.pair_geom2] = True
        return [bool(collides) for collides in by_bits]

    def pieces(self) -> tuple[tuple[Geom, ...], tuple[Opaque, ...]]:
        """The hulls, and the collision geometry that is none."""
        geoms, opaque = [], []
        bodies = self._body_names
        for k in range(self.model.ngeom):
            if not self.collides[k]:
                continue
            name, body = self.names[k], bodies[self.geom_body[k]]
            part = part_of(self.model, k, self.pose(k))
            if part.shape is not None:
                geoms.append(Geom(name, body, part.shape))
            else:
                opaque.append(Opaque(name, body, part.reason, part.surface))
        return tuple(geoms), tuple(opaque)

    def pose(self, geom: int) -> Pose:
        """root_T_geom as compiled: of a mesh, the frame in which its vertices are kept."""
        return Pose(self.data.geom_xmat[geom].reshape(3, 3), self.data.geom_xpos[geom])

    def authored(self) -> tuple[Authored, ...]:
        """The elements that geoms were made of, in document order; geoms without one each for itself, at the end."""
        order = {id(node): k for k, node in enumerate(self.flat.nodes)}
        copies: dict[int, list[int]] = {}
        for k, node in enumerate(self.elements):
            copies.setdefault(len(order) + k if node is None else order[id(node)], []).append(k)
        fixed = self._fixed()
        return tuple(self._entry(copies[key], fixed) for key in sorted(copies))

    def _entry(self, copies: list[int], fixed: dict[int, str]) -> Authored:
        first = copies[0]
        node = self.elements[first]
        why = fixed.get(id(node), "") if node else "it comes out of a sub-model that is attached"
        return Authored(
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            body=self._body_names[self.geom_body[first]],
            names=tuple(self.names[k] for k in copies),
            collides=any(self.collides[k] for k in copies),
            fixed=why,
        )

    def _fixed(self) -> dict[int, str]:
        """Why elements that make several geoms cannot be edited, by the identity of their nodes."""
        found: dict[int, str] = {}
        waiting: list[tuple[Node, str]] = [(self.flat.nodes[0], "")]
        while waiting:
            node, why = waiting.pop()
            why = why or _MANY.get(node.tag, "")
            if why:
                found[id(node)] = why
            waiting.extend((child, why) for child in node.children)
        return found

    @cached_property
    def _body_names(self) -> list[str]:
        return body_names([body.name for body in self.spec_bodies])

    def _body(self, k: int, names: list[str]) -> MjcfBody:
        model, body = self.model, self.spec_bodies[k]
        node = self.flat.node(body.info)
        return MjcfBody(
            name=names[k],
            parent=names[int(model.body_parentid[k])] if k else None,
            source=node.source if node else -1,
            start=node.element.start if node else -1,
            pose=Pose(self.data.xmat[k].reshape(3, 3), self.data.xpos[k]),
            inertial=Pose(rotation_of(model.body_iquat[k]), model.body_ipos[k]),
            mass=float(model.body_mass[k]),
            inertia=model.body_inertia[k].copy(),
            explicit=bool(body.explicitinertial),
        )


def rotation_of(quat: Floats) -> Floats:
    """The rotation (3, 3) of a unit quaternion w x y z."""
    w, x, y, z = quat / np.linalg.norm(quat)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
