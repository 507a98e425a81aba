"""What physics engines allow: one row a limit, each with its source."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType

from meshforge.checks.finding import Finding, Severity
from meshforge.checks.polygons import polygon_sizes
from meshforge.geometry import Polytope, principal_extents
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.words import counted, listed


@dataclass(frozen=True, slots=True)
class Limit:
    """The most that an engine takes of what `measure` counts, of a hull that is a mesh; what: the thing counted.

    problem: what becomes of a hull beyond it.
    """

    rule: str
    measure: Callable[[Polytope], float]
    most: float
    what: str
    severity: Severity
    problem: str
    remedy: str


def _vertices(hull: Polytope) -> float:
    return len(hull.vertices)


def _polygons(hull: Polytope) -> float:
    return len(polygon_sizes(hull))


def _largest_polygon(hull: Polytope) -> float:
    return max(polygon_sizes(hull))


def _oblong(hull: Polytope) -> float:
    extents = principal_extents(hull.vertices)[2]
    return float(extents.max() / extents.min())


_SIMPLER = "Replace the hull by a primitive, or split it."


def _most_vertices(most: int, severity: Severity, problem: str) -> Limit:
    return Limit("vertices", _vertices, most, "vertices", severity, problem, _SIMPLER)


def _most_polygons(most: int, severity: Severity, problem: str) -> Limit:
    return Limit("polygons", _polygons, most, "flat faces", severity, problem, _SIMPLER)


_COOKED = "PhysX leaves part of the hull out"
_ON_CPU = "PhysX falls back to the CPU or refuses it"

_LIMITS: dict[str, tuple[Limit, ...]] = {
    "mujoco": (
        # MJX warns, and leaves vertices out: mujoco/mjx/_src/mesh.py, _MAX_HULL_FACE_VERTICES and _merge_coplanar
        Limit(
            "face-vertices",
            _largest_polygon,
            20,
            "vertices on one flat face",
            "warning",
            "MJX leaves some out",
            _SIMPLER,
        ),
    ),
    "physx-cpu": (
        # PxConvexMeshDesc: vertexLimit at most 255, "the number of convex polygons is limited to 256"
        _most_vertices(255, "error", _COOKED),
        _most_polygons(256, "error", _COOKED),
    ),
    "physx-gpu": (
        # PxConvexMeshDesc: "vertices and convex polygons in a GPU compatible convex mesh is limited to 64";
        # PxConvexMesh::isGpuCompatible: no polygon of more than 32 vertices
        _most_vertices(64, "error", _ON_CPU),
        _most_polygons(64, "error", _ON_CPU),
        Limit("face-vertices", _largest_polygon, 32, "vertices on one flat face", "error", _ON_CPU, _SIMPLER),
        # "could not be built because of oblong shape", beyond about 64 to 1: mani-skill/ManiSkill#1152
        Limit("oblong", _oblong, 64, "to 1 from length to thickness", "warning", _ON_CPU, "Split it along its length."),
    ),
    "unreal": (
        # no hard limit; in practice 8 to 32 vertices
        _most_vertices(32, "warning", "more than is practical in Unreal"),
    ),
    "unity": (
        # Manual, Mesh Collider: convex ones are limited to 255; PhysX makes them, with its limits as above
        _most_vertices(255, "error", "Unity makes a partial hull of it"),
        _most_polygons(256, "error", "Unity makes a partial hull of it"),
    ),
    "bullet": (
        # no hard limit; in practice about 100 vertices
        _most_vertices(100, "warning", "more than is practical in Bullet"),
    ),
    "godot": (
        # Jolt, which Godot offers: ConvexHullShape::cMaxPointsInHull
        _most_vertices(256, "error", "the Jolt engine refuses it"),
    ),
}
ENGINES: tuple[str, ...] = tuple(_LIMITS)
"""The engines whose limits are known."""

_HULLS_OF_A_BODY = MappingProxyType({"physx-gpu": 64})  # no hard limit; practice in Isaac and SAPIEN
_MESH_FILES = ("obj", "stl", "ply")


def limits_of(engine: str, mesh: SymbolicMesh, faulty: frozenset[str]) -> tuple[Finding, ...]:
    """What is beyond the limits of an engine; `faulty` hulls are left out, and primitives, which engines have too."""
    hulls = [h for h in mesh.hulls if h.name not in faulty and isinstance(h.shape, Polytope)]
    found = [_beyond(engine, limit, hulls) for limit in _LIMITS[engine]]
    found += _crowded(engine, mesh) + _hulled_together(engine, mesh)
    return tuple(finding for finding in found if finding)


def _beyond(engine: str, limit: Limit, hulls: list[Hull]) -> Finding | None:
    counts = {h.name: limit.measure(h.shape) for h in hulls if isinstance(h.shape, Polytope)}
    over = {name: count for name, count in counts.items() if count > limit.most}
    if not over:
        return None
    told = listed([f"{name} ({count:.0f})" for name, count in over.items()])
    message = f"{told}: more than {limit.most:.0f} {limit.what}; {limit.problem}"
    return Finding(f"{engine}-{limit.rule}", limit.severity, tuple(over), message, limit.remedy)


def _crowded(engine: str, mesh: SymbolicMesh) -> list[Finding | None]:
    """Bodies of more hulls than the engine takes well."""
    most = _HULLS_OF_A_BODY.get(engine)
    if most is None:
        return []
    bodies: dict[str, list[str]] = {}
    for hull in mesh.hulls:
        bodies.setdefault(hull.body, []).append(hull.name)
    return [
        Finding(
            f"{engine}-hulls",
            "warning",
            tuple(names),
            f"body {body!r}: {counted(len(names), 'hull')}, more than {most}",
            "Merge small hulls.",
        )
        for body, names in bodies.items()
        if len(names) > most
    ]


def _hulled_together(engine: str, mesh: SymbolicMesh) -> list[Finding | None]:
    """A mesh file of several hulls: one mesh asset of MuJoCo is one convex hull (XML reference, asset/mesh)."""
    several = engine == "mujoco" and mesh.asset is not None and mesh.asset.format in _MESH_FILES
    if not several or len(mesh.hulls) < 2 or (mesh.asset and mesh.asset.path.is_dir()):
        return []
    names = tuple(hull.name for hull in mesh.hulls)
    message = f"{counted(len(names), 'hull')} in one mesh file; MuJoCo makes a single hull of them"
    return [Finding("mujoco-one-hull-a-file", "warning", names, message, "Write one file a hull, as for URDF or MJCF.")]
