"""What of a mesh is beyond the limits of an engine."""

from __future__ import annotations

from collections.abc import Iterator

from meshforge.checks.engines.limit import Engine, Limit
from meshforge.checks.finding import Finding
from meshforge.geometry import Polytope
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.words import counted, listed

_MESH_FILES = ("obj", "stl", "ply")


def limits_of(engine: Engine, mesh: SymbolicMesh, faulty: frozenset[str]) -> tuple[Finding, ...]:
    """What is beyond the limits of an engine; `faulty` hulls are left out."""
    hulls = [h for h in mesh.hulls if h.name not in faulty]
    limits = (finding for limit in engine.limits if (finding := _beyond(engine, limit, hulls)))
    return (*limits, *_foreign(engine, hulls), *_crowded(engine, mesh), *_hulled_together(engine, mesh))


def _beyond(engine: Engine, limit: Limit, hulls: list[Hull]) -> Finding | None:
    values = {h.name: limit.measure(h.shape) for h in hulls if isinstance(h.shape, Polytope)}
    over = {name: value for name, value in values.items() if limit.is_broken(value)}
    if not over:
        return None
    told = listed([f"{name} ({value:.4g})" for name, value in over.items()])
    less = "more" if limit.bound == "most" else "less"
    message = f"{told}: {less} than {limit.number:g} {limit.what}; {limit.problem}"
    return Finding(f"{engine.name}-{limit.rule}", limit.severity, tuple(over), message, limit.remedy)


def _foreign(engine: Engine, hulls: list[Hull]) -> Iterator[Finding]:
    """Native shapes that the engine lacks."""
    names = tuple(h.name for h in hulls if h.shape.is_primitive and h.shape.kind not in engine.primitives)
    if names:
        kinds = ", ".join(sorted({h.shape.kind for h in hulls if h.name in names}))
        message = f"{listed(names)}: {kinds}; {engine.instead}"
        remedy = f"Replace it by one that {engine.title} has ({', '.join(sorted(engine.primitives))})."
        yield Finding(f"{engine.name}-primitives", "warning", names, message, remedy)


def _crowded(engine: Engine, mesh: SymbolicMesh) -> Iterator[Finding]:
    """Bodies of more hulls than the engine takes well."""
    bodies: dict[str, list[str]] = {}
    for hull in mesh.hulls:
        bodies.setdefault(hull.body, []).append(hull.name)
    for body, names in bodies.items():
        if engine.hulls is not None and len(names) > engine.hulls:
            message = f"body {body!r}: {counted(len(names), 'hull')}, more than {engine.hulls}; {engine.hulls_problem}"
            yield Finding(f"{engine.name}-hulls", "warning", tuple(names), message, "Merge small hulls.")


def _hulled_together(engine: Engine, mesh: SymbolicMesh) -> Iterator[Finding]:
    """A mesh file of several hulls: one mesh asset of MuJoCo is one convex hull (XML reference, asset/mesh)."""
    several = engine.name == "mujoco" and mesh.asset is not None and mesh.asset.format in _MESH_FILES
    if not several or len(mesh.hulls) < 2 or (mesh.asset and mesh.asset.path.is_dir()):
        return
    names = tuple(hull.name for hull in mesh.hulls)
    message = f"{counted(len(names), 'hull')} in one mesh file; MuJoCo makes a single hull of them"
    yield Finding("mujoco-one-hull-a-file", "warning", names, message, "Write one file a hull, as for URDF or MJCF.")
