"""Physics engines: what each limit measures of a hull, and what of a mesh is beyond them, as findings; the engines, as
`engines.toml` has them, row by row, which `docs/engines.md` shows; and the codes of all findings, such as MF204, of
`codes.toml`: they stay the same over versions, for builds that look for them."""

import os
import tomllib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import Literal

import numpy as np

from meshforge import symbolic
from meshforge.common import UsageError, join_names, pluralize, suggest_among
from meshforge.geometry import LEVEL, Polytope, measure_extents, neighbour_faces, normals_of, polygon_sizes

Severity = Literal["error", "warning"]
Bound = Literal["most", "least"]

_SIMPLER = "Reduce it (check --fix), replace it by a primitive, or cut it."
_THICKER = "Give it a thickness, replace it by a box, or merge it with a neighbour."
_SHORTER = "Split it along its length."

MESH_FILES = ("obj", "stl", "ply")
"""Formats of which most engines make one hull a file (`Engine.merges_files`)."""


@dataclass(frozen=True, slots=True)
class RuleCode:
    """A code. rules: the names of the rules that it stands for; title: what is wrong; why: it matters; remedy: what to
    do; example: of an asset that has it."""

    code: str
    rules: tuple[str, ...]
    title: str
    why: str
    remedy: str
    example: str


_ROWS = tomllib.loads(files("meshforge.engines").joinpath("codes.toml").read_text("utf-8"))
CODES = MappingProxyType({code: RuleCode(code, tuple(row.pop("rules")), **row) for code, row in _ROWS.items()})
"""Every code, in order."""
CODES_BY_RULE = MappingProxyType({rule: code for code, row in CODES.items() for rule in row.rules})
"""The code of each rule; those of plug-ins have none."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A rule that does not hold, for the hulls it names.

    error: engines or this program will refuse or misread the hulls; warning: allowed, but worth a look.
    check: the name of the check that found it.
    """

    rule: str
    severity: Severity
    hulls: tuple[str, ...]
    message: str
    remedy: str
    check: str = "legality"

    @property
    def code(self) -> str | None:
        """The code of the rule, None for one of a plug-in."""
        return CODES_BY_RULE.get(self.rule)

    def relate_to(self, folder: Path) -> "Finding":
        """Return the same on every machine: paths in its message count from a folder."""
        return replace(self, message=self.message.replace(f"{folder}{os.sep}", ""))

    def __str__(self) -> str:
        """What is wrong, and on a line of its own, the remedy."""
        head = f"{self.severity} {self.code}" if self.code else self.severity
        return f"{head}: {self.message}" + (f"\n  {self.remedy}" if self.remedy else "")


@dataclass(frozen=True, slots=True)
class Limit:
    """The most, or the least, that an engine takes of what `measure` gives of a hull that is a mesh.

    what: the thing measured, with its unit; problem: what becomes of a hull beyond; source: where the number stands.
    """

    rule: str
    measure: Callable[[Polytope], float]
    number: float
    what: str
    severity: Severity
    problem: str
    remedy: str
    source: str
    bound: Bound = "most"

    def is_broken(self, value: float) -> bool:
        return value > self.number if self.bound == "most" else value < self.number


@dataclass(frozen=True, slots=True)
class Engine:
    """A physics engine.

    primitives: the kinds of native shapes it has; instead: what becomes of others; hulls: how many a body may have,
    None where nothing is known; the sources say where these stand.
    """

    name: str
    title: str
    limits: tuple[Limit, ...]
    primitives: frozenset[str]
    instead: str
    primitives_source: str
    hulls: int | None = None
    hulls_problem: str = ""
    hulls_source: str = ""

    @property
    def merges_files(self) -> bool:
        """Whether it makes one hull of a mesh file of several, as all but Bullet do (`_check_one_hull_a_file`)."""
        return self.name != "bullet"


def count_polygons_at_vertex(hull: Polytope) -> float:
    """Return the number of flat faces that meet at the vertex where most do."""
    pairs = neighbour_faces(hull.faces)
    normals = normals_of(hull)
    bent = np.linalg.norm(np.cross(normals[pairs[:, 0]], normals[pairs[:, 1]]), axis=1) > LEVEL
    edges = [np.intersect1d(hull.faces[i], hull.faces[j]) for i, j in pairs[bent]]
    return int(np.bincount(np.concatenate(edges)).max()) if edges else 0


def measure_slenderness(hull: Polytope) -> float:
    """Return the largest extent, as a multiple of the diameter of the sphere about the centre of mass within it."""
    normals = normals_of(hull)
    heights = np.einsum("ij,ij->i", hull.vertices[hull.faces[:, 0]] - hull.centroid, normals)
    inner = float(heights[np.linalg.norm(normals, axis=1) > 0.5].min())
    return float(measure_extents(hull.vertices)[0]) / max(2 * inner, np.finfo(float).tiny)


_RULES: dict[str, tuple[Callable[[Polytope], float], str, Bound, str]] = {
    "vertices": (lambda hull: len(hull.vertices), "vertices", "most", _SIMPLER),
    "polygons": (lambda hull: len(polygon_sizes(hull)), "flat faces", "most", _SIMPLER),
    "face-vertices": (lambda hull: max(polygon_sizes(hull)), "vertices on one flat face", "most", _SIMPLER),
    "vertex-faces": (count_polygons_at_vertex, "flat faces at one vertex", "most", _SIMPLER),
    "oblong": (measure_slenderness, "times as long as the sphere inside is wide", "most", _SHORTER),
    "thin": (lambda hull: float(measure_extents(hull.vertices)[2]), "m thick", "least", _THICKER),
    "volume": (lambda hull: hull.volume, "m³", "least", _THICKER),
}


def make_limit(rule: str, number: float, severity: Severity, problem: str, source: str) -> Limit:
    """Return a limit of one of the rules that there are; number: the most, or the least, as the rule has it."""
    measure, what, bound, remedy = _RULES[rule]
    return Limit(rule, measure, number, what, severity, problem, remedy, source, bound)


def check_limits(engine: Engine, mesh: symbolic.SymbolicMesh, faulty: frozenset[str]) -> tuple[Finding, ...]:
    """Return what is beyond the limits of an engine; `faulty` hulls are left out."""
    hulls = [h for h in mesh.hulls if h.name not in faulty]
    return (
        *(finding for limit in engine.limits if (finding := check_limit(engine, limit, hulls))),
        *check_primitives(engine, hulls),
        *_check_hull_counts(engine, mesh),
        *_check_one_hull_a_file(engine, mesh),
        *_check_names(engine, mesh),
    )


def _check_names(engine: Engine, mesh: symbolic.SymbolicMesh) -> Iterator[Finding]:
    for of, name, problem, remedy, is_hull in mesh.asset.name_problems if mesh.asset else ():
        if of == engine.name and (not is_hull or any(hull.name == name for hull in mesh.hulls)):
            yield Finding(f"{of}-name", "error", (name,) if is_hull else (), f"{name}: {problem}", remedy)


def check_limit(engine: Engine, limit: Limit, hulls: Sequence[symbolic.Hull]) -> Finding | None:
    """Return the hulls that are meshes and beyond a limit; None where there are none."""
    values = {h.name: limit.measure(h.shape) for h in hulls if isinstance(h.shape, Polytope)}
    over = {name: value for name, value in values.items() if limit.is_broken(value)}
    if not over:
        return None
    names = join_names([f"{name} ({value:.4g})" for name, value in over.items()])
    less = "more" if limit.bound == "most" else "less"
    message = f"{names}: {less} than {limit.number:g} {limit.what}; {limit.problem}"
    return Finding(f"{engine.name}-{limit.rule}", limit.severity, tuple(over), message, limit.remedy)


def check_primitives(engine: Engine, hulls: Sequence[symbolic.Hull]) -> Iterator[Finding]:
    """Yield native shapes that the engine lacks."""
    names = tuple(h.name for h in hulls if h.shape.is_primitive and h.shape.kind not in engine.primitives)
    if names:
        kinds = ", ".join(sorted({h.shape.kind for h in hulls if h.name in names}))
        message = f"{join_names(names)}: {kinds}; {engine.instead}"
        remedy = f"Replace it by one that {engine.title} has ({', '.join(sorted(engine.primitives))})."
        yield Finding(f"{engine.name}-primitives", "warning", names, message, remedy)


def _check_hull_counts(engine: Engine, mesh: symbolic.SymbolicMesh) -> Iterator[Finding]:
    bodies: dict[str, list[str]] = {}
    for hull in mesh.hulls:
        bodies.setdefault(hull.body, []).append(hull.name)
    for body, names in bodies.items():
        if engine.hulls is not None and len(names) > engine.hulls:
            message = (
                f"body {body!r}: {pluralize(len(names), 'hull')}, more than {engine.hulls}; {engine.hulls_problem}"
            )
            yield Finding(f"{engine.name}-hulls", "warning", tuple(names), message, "Merge small hulls.")


def _check_one_hull_a_file(engine: Engine, mesh: symbolic.SymbolicMesh) -> Iterator[Finding]:
    """A mesh file of several hulls, of which an engine makes one; PyBullet is asked itself.

    An error where that was tried: one mesh asset of MuJoCo is one convex hull (XML reference, asset/mesh). PhysX makes
    one of a convex mesh (PxConvexMeshDesc), Unity of a Mesh Collider that is convex (manual), Godot of a mesh
    (Mesh.create_convex_shape), and Unreal finds none in a file without its names; but what imports a file, as SAPIEN
    does, may split it before.
    """
    asset, names = mesh.asset, tuple(hull.name for hull in mesh.hulls)
    if not engine.merges_files or asset is None or asset.format not in MESH_FILES or len(names) < 2:
        return
    outs = {"mujoco": "OUT.xml", "physx-cpu": "OUT.usda", "physx-gpu": "OUT.usda"}
    out = outs.get(engine.name, f"OUT.glb --names {engine.name}")
    message = f"{pluralize(len(names), 'hull')} in one mesh file; {engine.title} makes a single hull of them"
    severity: Severity = "error" if engine.name == "mujoco" else "warning"
    remedy = f"Write each hull by itself: meshforge convert FILE {out}"
    yield Finding(f"{engine.name}-one-hull-a-file", severity, names, message, remedy)


def _read_engines() -> Iterator[Engine]:
    text = files("meshforge.engines").joinpath("engines.toml").read_text("utf-8")
    for name, row in tomllib.loads(text).items():
        limits = tuple(make_limit(**limit) for limit in row.pop("limits"))
        yield Engine(name, limits=limits, primitives=frozenset(row.pop("primitives")), **row)


ENGINES = MappingProxyType({engine.name: engine for engine in _read_engines()})
"""The engines whose limits are known, by the name that the command line takes."""


def find_engine(name: str) -> Engine:
    """Return the engine of a name. Raises UsageError for one that is not known."""
    if name not in ENGINES:
        raise UsageError(f"there is no engine {name!r}", remedy=suggest_among(name, ENGINES, "Known are:"))
    return ENGINES[name]
