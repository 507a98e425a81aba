"""The learning process' side: what it is asked to do, with the family that it keeps in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from time import perf_counter

from meshforge.batch import RECORD_FILE, source_files
from meshforge.common import FileStates, MeshForgeError, file_states
from meshforge.language import Program, parse_extractor
from meshforge.project import Project, select_assets
from meshforge.studio.learning.queue import CancelToken
from meshforge.studio.learning.results import ProgramWithTemplates, RuleSelector, build_lesson_view, measure_reach
from meshforge.studio.wire.program import Generalised, LessonView, Reach
from meshforge.symbolic import SymbolicMesh, transfer_labels

RENEW_AFTER = 64
"""Lessons after which memory is given back: each that meets a new rule leaves about 25 kB an asset (measured on tables
of 40 hulls), and the lesson after that takes some tenths of a second longer."""


@cache
def _family_cache(folder: Path) -> FamilyCache:
    return FamilyCache()


@cache
def _rule_selector(folder: Path) -> RuleSelector:
    return RuleSelector()


def learn(folder: Path, ticket: CancelToken, number: int, take: bool) -> LessonView:
    """A lesson from a project as it is now."""
    begun, stop = perf_counter(), ticket.stop
    try:
        project = Project.open(folder)
        shelf = _family_cache(folder)
        shelf.count_run()
        meshes = dict(shelf.read_meshes(project, select_assets(project), stop))
        accept = take or not project.program_state().by_hand
        outcome = project.synthesize(accept=accept, meshes=meshes, stop=stop)
    except ReadInterrupted:
        return LessonView(number=number, status="timeout", seconds=perf_counter() - begun)
    except MeshForgeError as error:
        return LessonView(number=number, status="error", error=error.message, seconds=perf_counter() - begun)
    return build_lesson_view(number, outcome, len(meshes), perf_counter() - begun)


def compute_reach(folder: Path, ticket: CancelToken, program: str) -> tuple[Reach, ...] | None:
    """What a program does on every asset that can be read, None where it was interrupted.

    Of a family of more than 400 only on those that are looked at while learning (`select_assets`): all assets of a
    family without bounds do not go into memory, and reading them anew after each change would take minutes.
    """
    project = Project.open(folder)
    plan = _load_program(project, Program.parse(program))
    try:
        rows = _family_cache(folder).read_meshes(project, select_assets(project), ticket.stop)
        return tuple(measure_reach(plan, asset, mesh) for asset, mesh in rows)
    except ReadInterrupted:
        return None


def generalise(folder: Path, ticket: CancelToken, extractor: str, rule: int, program: str | None) -> Generalised | None:
    """What an extractor selects on the assets that `compute_reach` looks at, None where it was interrupted."""
    project, wanted = Project.open(folder), parse_extractor(extractor)
    thresholds = project.settings.thresholds
    bare = Program(orient=project.orientation, contact=thresholds.contact, extremity=thresholds.extremity)
    plan = _load_program(project, (Program.parse(program) if program else bare), rule)
    meetings = _rule_selector(folder)
    try:
        rows = _family_cache(folder).read_meshes(project, select_assets(project), ticket.stop)
        return Generalised(assets={asset: meetings.select(plan, mesh, wanted) for asset, mesh in rows})
    except ReadInterrupted:
        return None


def _load_program(project: Project, program: Program, before: int | None = None) -> ProgramWithTemplates:
    """A program with its templates; before: only of its rules before that one."""
    rules = program.rules if before is None else program.rules[: max(0, before - 1)]
    shortened = Program(program.labels, program.orient, rules, program.contact, program.extremity)
    return ProgramWithTemplates(shortened, project.templates(shortened.templates))


class ReadInterrupted(Exception):  # noqa: N818 (not an error: nobody waits for the rest)
    """Reading was interrupted."""


@dataclass(frozen=True, eq=False, slots=True)
class _CacheEntry:
    """An asset as it was read. times: of its files; labels: what their file holds; mesh: None where it cannot be read.

    contact: the threshold that was set.
    """

    times: FileStates
    contact: float | None
    labels: bytes
    mesh: SymbolicMesh | None


class FamilyCache:
    """The assets of a project, with the labels they have when they are asked for."""

    def __init__(self) -> None:
        self._entries: dict[str, _CacheEntry] = {}
        self._runs = 0

    def read_meshes(
        self, project: Project, assets: Iterable[str], stop: Callable[[], bool]
    ) -> Iterator[tuple[str, SymbolicMesh]]:
        """Those of some assets that can be read, with their ids. Raises Stopped when `stop` says so."""
        contact = project.settings.thresholds.contact
        for asset in assets:
            if stop():
                raise ReadInterrupted
            kept = self._entries[asset] = self._update(project, asset, contact)
            if kept.mesh is not None:
                yield asset, kept.mesh

    def count_run(self) -> None:
        """Count a lesson. After many, what was worked out about the assets meanwhile is forgotten."""
        self._runs += 1
        if self._runs % RENEW_AFTER == 0:
            self._entries = {asset: _renew(kept) for asset, kept in self._entries.items()}

    def _update(self, project: Project, asset: str, contact: float | None) -> _CacheEntry:
        kept, labels = self._entries.get(asset), _read_labels(project, asset)
        if kept is None or kept.contact != contact or file_states(kept.times) != kept.times:
            return _read(project, asset, contact, labels)
        if kept.labels == labels:
            return kept
        if kept.mesh is None:
            return _read(project, asset, contact, labels)
        return _CacheEntry(kept.times, contact, labels, _apply_labels(project, asset, kept.mesh))


def _read(project: Project, asset: str, contact: float | None, labels: bytes) -> _CacheEntry:
    path = project.path(asset)
    times = file_states([path, *source_files(path), project.layout.preparation(asset) / RECORD_FILE])
    try:
        mesh = project.mesh(asset)
    except MeshForgeError:
        return _CacheEntry(times, contact, labels, None)
    referred = mesh.asset.files if mesh.asset else ()
    return _CacheEntry(file_states(referred) | times, contact, labels, mesh)


def _renew(kept: _CacheEntry) -> _CacheEntry:
    """The same with another mesh object; what was worked out about the old one goes with it."""
    return kept if kept.mesh is None else replace(kept, mesh=kept.mesh.with_hulls(kept.mesh.hulls))


def _apply_labels(project: Project, asset: str, mesh: SymbolicMesh) -> SymbolicMesh | None:
    """The mesh with the labels it has now; what was measured between its hulls stays known."""
    try:
        return transfer_labels(project.labels(asset), mesh.with_labels(dict.fromkeys(mesh.index))).mesh
    except MeshForgeError:
        return None


def _read_labels(project: Project, asset: str) -> bytes:
    path = project.layout.labels(asset)
    return path.read_bytes() if path.exists() else b""
