"""Newton: URDF, MJCF and USD."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull


def _shapes(path: Path) -> Iterator[Seen]:
    warnings.simplefilter("ignore")
    import newton
    import warp

    warp.config.quiet = True
    builder, metres = newton.ModelBuilder(), 1.0
    match path.suffix:
        case ".urdf":
            builder.add_urdf(str(path))
        case ".xml":
            builder.add_mjcf(str(path))
        case _:
            metres = builder.add_usd(str(path), skip_mesh_approximation=True)["linear_unit"]
    model = builder.finalize(device="cpu")
    state = model.state()
    newton.eval_fk(model, model.joint_q, model.joint_qd, state)
    bodies = state.body_q.numpy() if model.body_count else []
    own, flags = model.shape_transform.numpy(), model.shape_flags.numpy()
    for k in np.flatnonzero(flags & int(newton.ShapeFlags.COLLIDE_SHAPES)):
        body, place = int(model.shape_body.numpy()[k]), Place.of_quaternion(own[k][:3], own[k][3:])
        if body >= 0:
            place = Place.of_quaternion(bodies[body][:3], bodies[body][3:]) @ place
        kind = newton.GeoType(int(model.shape_type.numpy()[k])).name
        for seen in _told(kind, model, int(k), place):
            yield Seen(seen.kind, tuple(metres * x for x in seen.reach))


def _told(kind: str, model: Any, k: int, place: Place) -> Iterator[Seen]:
    size = model.shape_scale.numpy()[k]
    match kind:
        case "BOX":
            yield box(size, place)
        case "SPHERE":
            yield ellipsoid(size[0], place, "sphere")
        case "ELLIPSOID":
            yield ellipsoid(size, place)
        case "CAPSULE":
            yield capsule(size[0], size[1], place)
        case "CYLINDER":
            yield cylinder(size[0], size[1], place)
        case "MESH" | "CONVEX_MESH":
            yield hull(model.shape_source[k].vertices * size, place)


READER = Reader(
    "Newton",
    "newton[importers]",
    "newton",
    dict.fromkeys((".urdf", ".xml", ".usda", ".usdc", ".usdz"), "shape"),
    _shapes,
    about="It leaves the unit of a stage to its caller; an option keeps it from approximating meshes.",
)
