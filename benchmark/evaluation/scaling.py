"""Cost of growth: learning a task and applying it, against meshes, hulls a mesh and labels, one varied at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import log
from time import perf_counter

import numpy as np

from benchmark.report import Cell, Result, Table, Tell
from benchmark.tasks import Task, task
from meshforge import Demonstration, Step, synthesize
from meshforge.geometry import Aabb, Box, Polytope, cut
from meshforge.symbolic import Hull, Label, SymbolicMesh

TASK = "table-medium"
VARIED: dict[str, tuple[int, ...]] = {
    "meshes": (25, 100, 400, 1600, 10_000),
    "hulls a mesh": (10, 20, 40, 80, 160, 320, 500),
    "labels": (3, 4, 6, 8, 10, 12),
}
_QUICK: dict[str, tuple[int, ...]] = {"meshes": (15, 30), "hulls a mesh": (10, 20), "labels": (3, 4)}
_MESHES, _SHOWN, _SEED = 50, 2, 7


@dataclass(frozen=True, slots=True)
class Point:
    """Seconds of learning (its search and its replay over the batch) and of applying, at one value."""

    value: int
    hulls: int
    contacts: float
    search: float
    replay: float
    applying: float
    status: str


def measure(tell: Tell, quick: bool) -> Result:
    """Time learning from two demonstrations and applying to all, at each value."""
    tables, notes = [], []
    for what, values in (_QUICK if quick else VARIED).items():
        points = []
        for value in values:
            points.append(_point(what, value, quick))
            tell(f"scaling: {value} {what}")
        columns = (what, "hulls in all", "contacts, s", "search, s", "replay, s", "applying, s", "outcome")
        tables.append(Table(what.capitalize(), columns, tuple(map(_cells, points))))
        notes.append(_sentence(what, points))
    return Result(
        "scaling",
        "Cost of growth",
        tuple(tables),
        notes=(
            f"The task {TASK}: its meshes repeated, each with every side stretched by a factor of its own; hulls cut "
            f"in two, or left out, until the number is reached; further labels on small boxes beside the mesh. If the "
            f"number of meshes is not what varies: {_MESHES} meshes as they are. Demonstrated on two meshes; one "
            "process, one run. *Contacts*: contact graphs of all meshes, computed once; *search*: rules, readings, "
            "repair; *replay*: the rules on all meshes while learning; *applying*: the learned program on all meshes, "
            "in memory; learning, too, is called on meshes in memory: of more than 400 assets a project takes some.",
            *notes,
        ),
    )


def _cells(point: Point) -> tuple[Cell, ...]:
    times = (point.contacts, point.search, point.replay, point.applying)
    return (point.value, point.hulls, *times, point.status)


def _point(what: str, value: int, quick: bool) -> Point:
    one, rng = task(TASK), np.random.default_rng([_SEED, value])
    count = value if what == "meshes" else (15 if quick else _MESHES)
    base = [sample.mesh for sample in one.samples() if not one.impure(sample)]
    meshes: dict[str, SymbolicMesh] = {}
    for k in range(count):
        mesh = _stretch(base[k % len(base)], rng)
        if what == "hulls a mesh":
            mesh = _with_hulls(mesh, value)
        meshes[f"mesh {k:05}"] = _with_labels(mesh, value, one, rng) if what == "labels" else mesh
    start = perf_counter()
    for mesh in meshes.values():
        assert mesh.contacts is not None
    contacts = perf_counter() - start
    return _time(one, value, meshes, contacts)


def _time(one: Task, value: int, meshes: Mapping[str, SymbolicMesh], contacts: float) -> Point:
    program = one.program
    shown = _choose_demonstrations(one, meshes)
    present = {hull.label for mesh in meshes.values() for hull in mesh.hulls if hull.label}
    vocabulary = sorted(present | set(program.labels))
    demos = [_demonstration(one, name, meshes[name]) for name in shown]
    outcome = synthesize(demos, meshes, program.orient, one.templates, vocabulary, confirm=lambda _: False)
    start = perf_counter()
    for mesh in meshes.values():
        one.run(outcome.program or program, mesh)
    applying = perf_counter() - start
    hulls = sum(len(mesh.hulls) for mesh in meshes.values())
    spent = outcome.seconds
    return Point(value, hulls, contacts, spent["search"], spent["replay"], applying, outcome.status)


def _choose_demonstrations(one: Task, meshes: Mapping[str, SymbolicMesh]) -> list[str]:
    """The first two meshes on which every rule has something to do."""
    rows = ((name, one.select(one.program, mesh)) for name, mesh in meshes.items())
    able = (name for name, done in rows if done and all(done))
    found = [name for name, _ in zip(able, range(_SHOWN), strict=False)]
    assert found, "the task has a mesh that shows all of its rules"
    return found


def _demonstration(one: Task, name: str, mesh: SymbolicMesh) -> Demonstration:
    chosen = one.select(one.program, mesh) or ()
    rows = enumerate(zip(one.program.rules, chosen, strict=True), 1)
    return Demonstration(mesh, [Step(k, names, rule.action, rule.label) for k, (rule, names) in rows], name)


def _stretch(mesh: SymbolicMesh, rng: np.random.Generator) -> SymbolicMesh:
    """The mesh with every side longer or shorter by up to a tenth."""
    linear = np.diag(np.exp(rng.uniform(-0.1, 0.1, 3)))
    return SymbolicMesh(
        tuple(Hull(h.name, h.body, h.shape.transform(linear, np.zeros(3)), h.annotation) for h in mesh.hulls)
    )


def _with_hulls(mesh: SymbolicMesh, count: int) -> SymbolicMesh:
    """The mesh with so many hulls: the largest are cut in two across, or the smallest left out."""
    shapes = [(h.shape, h.annotation) for h in sorted(mesh.hulls, key=lambda h: -h.volume)][:count]
    while len(shapes) < count:
        shapes.sort(key=lambda row: -row[0].volume)
        (shape, label), *rest = shapes
        axis = int(np.argmax(shape.aabb.size))
        halves = cut(shape, shape.aabb.center, np.eye(3)[axis])
        shapes = [*rest, *((half, label) for half in halves if half is not None)]
    return SymbolicMesh(tuple(Hull(f"hull_{k:03}", "body", shape, label) for k, (shape, label) in enumerate(shapes)))


def _with_labels(mesh: SymbolicMesh, count: int, one: Task, rng: np.random.Generator) -> SymbolicMesh:
    """The mesh with so many labels: others than the rules' become `misc`, or small boxes of new ones lie beside it."""
    kept = sorted(one.labels | {"misc"})
    hulls = [h if h.label in kept else h.with_label(Label("misc", 1.0, "file")) for h in mesh.hulls]
    low = mesh.aabb.max + 0.1 if mesh.aabb else np.zeros(3)
    for k in range(count - len(kept)):
        corner = low + rng.uniform(0.0, 0.3, 3)
        shape: Polytope | Box = Box.of_bounds(Aabb(corner, corner + 0.02))
        hulls.append(Hull(f"extra_{k}", "body", shape, Label(f"extra{k}", 1.0, "file")))
    return SymbolicMesh(tuple(hulls))


def _sentence(what: str, points: Sequence[Point]) -> str:
    parts = ", ".join(f"{name} with the power {power:.2g}" for name, power in _powers(points))
    grows = parts.replace(" with", " grows with", 1)
    return f"{what.capitalize()}, {points[0].value:,} to {points[-1].value:,}: time for {grows} of their number."


def _powers(points: Sequence[Point]) -> Iterator[tuple[str, float]]:
    values = [log(point.value) for point in points]
    for name in ("search", "replay", "applying"):
        seconds = [log(max(float(getattr(point, name)), 1e-6)) for point in points]
        yield name, float(np.polyfit(values, seconds, 1)[0])
