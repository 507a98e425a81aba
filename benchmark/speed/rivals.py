"""Other ways to find the touching pairs of hulls: trimesh's collision manager, PyBullet, python-fcl, bare coal.

Each has a build step, from arrays of vertices and faces to its own objects, and a query step, from these to the pairs.
All are to give the same answer: the pairs no farther apart than a distance.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshforge.geometry import Polytope

Pairs = frozenset[tuple[int, int]]


class Trimesh:
    """trimesh's CollisionManager, with its own broad phase.

    Its methods tell the nearest pair or the pairs in collision only, so its broad phase is asked with a callback of
    ours, which prunes what is farther apart than the distance.
    """

    name = "trimesh CollisionManager"

    def __init__(self, shapes: Sequence[Polytope], near: float, pairs: Sequence[tuple[int, int]]) -> None:
        self.shapes, self.near = shapes, near

    def build(self) -> Any:
        import trimesh

        manager: Any = trimesh.collision.CollisionManager()  # type: ignore[no-untyped-call]  # has no types
        for k, shape in enumerate(self.shapes):
            manager.add_object(str(k), trimesh.Trimesh(shape.vertices, shape.faces, process=False))
        return manager

    def query(self, manager: Any) -> Pairs:
        import fcl

        request = fcl.DistanceRequest()
        found = []

        def visit(one: Any, other: Any, _: Any) -> tuple[bool, float]:
            result = fcl.DistanceResult()
            if fcl.distance(one, other, request, result) <= self.near:
                i, j = sorted(int(manager._extract_name(end)) for end in (result.o1, result.o2))
                found.append((i, j))
            return False, self.near * (1 + 1e-12)

        manager._manager.distance(None, visit)
        return frozenset(found)


class Fcl:
    """python-fcl on pairs whose boxes are near, its convex shapes made from the arrays without asking trimesh."""

    name = "python-fcl, pairs given"

    def __init__(self, shapes: Sequence[Polytope], near: float, pairs: Sequence[tuple[int, int]]) -> None:
        self.shapes, self.near, self.pairs = shapes, near, pairs

    def build(self) -> Any:
        import fcl

        return [fcl.CollisionObject(self._convex(shape), fcl.Transform()) for shape in self.shapes]

    def _convex(self, shape: Polytope) -> Any:
        import fcl

        rows = np.column_stack([np.full(len(shape.faces), 3), shape.faces])
        return fcl.Convex(shape.vertices, len(rows), rows.ravel())

    def query(self, objects: Any) -> Pairs:
        import fcl

        request = fcl.DistanceRequest()
        return frozenset(
            (i, j)
            for i, j in self.pairs
            if fcl.distance(objects[i], objects[j], request, fcl.DistanceResult()) <= self.near
        )


class Bullet:
    """PyBullet's getClosestPoints on the bodies that it finds in the grown box of each.

    Bullet rounds hulls by a margin of a millimetre; in coordinates where all hulls together are 1 km long, that is a
    thousandth of the distance asked for.
    """

    name = "PyBullet getClosestPoints"

    def __init__(self, shapes: Sequence[Polytope], near: float, pairs: Sequence[tuple[int, int]]) -> None:
        import pybullet

        vertices = np.concatenate([shape.vertices for shape in shapes])
        self.scale = 1000.0 / float(np.linalg.norm(np.ptp(vertices, axis=0)))
        self.near = near * self.scale
        self.shapes = shapes
        self.world = pybullet.connect(pybullet.DIRECT)

    def build(self) -> Any:
        import pybullet

        bodies = []
        for points in [(shape.vertices * self.scale).tolist() for shape in self.shapes]:
            shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=points, physicsClientId=self.world)
            bodies.append(pybullet.createMultiBody(0, shape, physicsClientId=self.world))
        return bodies

    def query(self, bodies: Any) -> Pairs:
        import pybullet

        number = {body: k for k, body in enumerate(bodies)}
        found: list[tuple[int, int]] = []
        for i, body in enumerate(bodies):
            low, high = pybullet.getAABB(body, physicsClientId=self.world)
            grown = [x - self.near for x in low], [x + self.near for x in high]
            near = pybullet.getOverlappingObjects(*grown, physicsClientId=self.world) or ()
            found += [
                (i, j)
                for j in {number[other] for other, _ in near if number[other] > i}
                if pybullet.getClosestPoints(body, bodies[j], self.near, physicsClientId=self.world)
            ]
        return frozenset(found)

    def reset(self) -> None:
        import pybullet

        pybullet.resetSimulation(physicsClientId=self.world)

    def close(self) -> None:
        import pybullet

        pybullet.disconnect(self.world)


class Coal:
    """coal called on pairs whose boxes are near, with its shapes made from points and triangles one by one."""

    name = "bare coal, pairs given"

    def __init__(self, shapes: Sequence[Polytope], near: float, pairs: Sequence[tuple[int, int]]) -> None:
        vertices = np.concatenate([shape.vertices for shape in shapes])
        self.size, self.middle = float(np.linalg.norm(np.ptp(vertices, axis=0))), vertices.mean(axis=0)
        self.shapes, self.near, self.pairs = shapes, near / self.size, pairs

    def build(self) -> Any:
        import coal

        shapes = []
        for shape in self.shapes:
            points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
            points.extend(list((shape.vertices - self.middle) / self.size))
            triangles.extend([coal.Triangle(a, b, c) for a, b, c in shape.faces.tolist()])
            shapes.append(coal.Convex(points, triangles))
        return shapes

    def query(self, shapes: Any) -> Pairs:
        import coal

        request, result, still = coal.DistanceRequest(), coal.DistanceResult(), coal.Transform3s()
        request.enable_signed_distance, request.gjk_tolerance, request.gjk_max_iterations = False, 1e-10, 512
        found = []
        for i, j in self.pairs:
            result.clear()
            if coal.distance(shapes[i], still, shapes[j], still, request, result) <= self.near:
                found.append((i, j))
        return frozenset(found)
