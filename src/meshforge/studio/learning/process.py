"""What the learning process does: it learns programs, and keeps the meshes of the family in memory."""

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from meshforge.common import MeshForgeError, StoppedError
from meshforge.language import Program, parse_extractor
from meshforge.project import (
    AssessmentBasis,
    Project,
    assess_family,
    digest_inputs,
    program_by_hand,
    sees_whole_family,
    select_assets,
)
from meshforge.signoff import THRESHOLD
from meshforge.store import MeshCache
from meshforge.studio.learning.queue import CancelToken
from meshforge.studio.learning.results import (
    ProgramWithTemplates,
    build_outcome_view,
    measure_reach,
    select_after,
    view_assessment,
)
from meshforge.studio.wire.family import AssessmentView
from meshforge.studio.wire.program import CoverageView, OutcomeView, Reach
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import LearningOutcome

RENEW_AFTER = 64
"""Learning runs after which memory is given back: each that has a new rule leaves about 25 kB an asset (measured on
tables of 40 hulls). The run after that takes some tenths of a second longer."""


@dataclass(frozen=True, eq=False, slots=True)
class _LastRun:
    """What the last learning run of a project came to. meshes: what it learned from, by asset; digest: of all else."""

    number: int
    outcome: LearningOutcome
    meshes: Mapping[str, SymbolicMesh]
    digest: str

    def holds(self, meshes: Mapping[str, SymbolicMesh], digest: str) -> bool:
        same = meshes.keys() == self.meshes.keys() and all(meshes[name] is mesh for name, mesh in self.meshes.items())
        return same and digest == self.digest


def learn(folder: Path, token: CancelToken, number: int) -> OutcomeView:
    """Learn a program from a project as it is now; it replaces the accepted one unless a person wrote that."""
    stop, memory = token.stop, _memory_of(folder)
    try:
        project = Project.open(folder)
        memory.family.count_run()
        digest = digest_inputs(project)
        meshes = dict(memory.family.read_meshes(project, select_assets(project), stop))
        if any(now is not meshes[asset] for asset, now in project.update_classes(meshes).items()):
            meshes = dict(memory.family.read_meshes(project, select_assets(project), stop))
        outcome = project.synthesize(accept=not project.program_state().by_hand, meshes=meshes, stop=stop)
    except StoppedError:
        return OutcomeView(number=number, status="timeout")
    except MeshForgeError as error:
        return OutcomeView(number=number, status="error", error=error.message)
    memory.last = _LastRun(number, outcome, meshes, digest)
    return build_outcome_view(number, outcome, len(meshes))


def assess(folder: Path, token: CancelToken, number: int) -> AssessmentView | None:
    """Return how sure the edits are that a learning run came to, None where that was interrupted, or was not the last
    one.

    It is kept, as a review is, where nothing changed since that run and it looked at all assets. None too where nothing
    is demonstrated yet.
    """
    memory, project = _memory_of(folder), Project.open(folder)
    last = memory.last
    if last is None or last.number != number or not project.demonstration_ids():
        return None
    basis = AssessmentBasis.take(project)
    meshes = dict(memory.family.read_meshes(project, select_assets(project), token.stop))
    by_hand, kept = program_by_hand(project), project.assessment()
    program, threshold = by_hand or last.outcome, kept.threshold if kept else THRESHOLD
    made = assess_family(project, meshes, program, basis, threshold, by_hand=by_hand is not None, stop=token.stop)
    if made is None:
        return None
    is_whole = made.program is not None and sees_whole_family(project)
    if is_whole and last.holds(meshes, basis.inputs_digest):
        with suppress(MeshForgeError, OSError):  # pages show it all the same
            if made.keep(project):
                project.renew_sign_offs(keep_persons=True)
    unseen = len(project.assets()) - len(meshes)
    return view_assessment(made.found, made.state, made.program is not None, unseen)


def compute_reach(folder: Path, token: CancelToken, program: str) -> tuple[Reach, ...]:
    """Return what a program does on every asset that can be read. Raises StoppedError where it was interrupted.

    In a family of more than 400 only on those that learning looks at (`select_assets`): memory has no room for all
    assets of a very large family, and reading them anew after each change would take minutes.
    """
    project = Project.open(folder)
    plan = _load_program(project, Program.parse(program))
    rows = _memory_of(folder).family.read_meshes(project, select_assets(project), token.stop)
    return tuple(measure_reach(plan, asset, mesh) for asset, mesh in rows)


def generalise(folder: Path, token: CancelToken, extractor: str, rule: int, program: str | None) -> CoverageView:
    """Return what an extractor selects on the assets that `compute_reach` looks at. Raises StoppedError.

    rule: the number of the rule that it belongs to; program: whose rules before that one are applied first.
    """
    project, wanted = Project.open(folder), parse_extractor(extractor)
    thresholds = project.settings.thresholds
    bare = Program(orient=project.orientation, contact=thresholds.contact, extremity=thresholds.extremity)
    plan = _load_program(project, (Program.parse(program) if program else bare), rule)
    rows = _memory_of(folder).family.read_meshes(project, select_assets(project), token.stop)
    return CoverageView(assets={asset: select_after(plan, mesh, wanted) for asset, mesh in rows})


def _load_program(project: Project, program: Program, before: int | None = None) -> ProgramWithTemplates:
    rules = program.rules if before is None else program.rules[: max(0, before - 1)]
    shortened = Program(program.labels, program.orient, rules, program.contact, program.extremity)
    return ProgramWithTemplates(shortened, project.templates(shortened.templates))


class FamilyCache:
    """The assets of a project, with the labels they have when they are asked for."""

    def __init__(self) -> None:
        self._meshes = MeshCache(most=sys.maxsize)
        self._runs = 0

    def read_meshes(
        self, project: Project, assets: Iterable[str], stop: Callable[[], bool]
    ) -> Iterator[tuple[str, SymbolicMesh]]:
        """Yield the ids and meshes of those assets that can be read. Raises StoppedError when `stop` says so."""
        cached = project.with_cache(self._meshes)
        for asset in assets:
            if stop():
                raise StoppedError("nobody waits for it any more")
            with suppress(MeshForgeError):
                yield asset, cached.mesh(asset)

    def count_run(self) -> None:
        """Count a learning run. After many of them, what was worked out about the assets meanwhile is forgotten."""
        self._runs += 1
        if self._runs % RENEW_AFTER == 0:
            self._meshes.renew()


@dataclass(slots=True)
class _Memory:
    """What stays in memory of a project."""

    family: FamilyCache = field(default_factory=FamilyCache)
    last: _LastRun | None = None


@cache
def _memory_of(folder: Path) -> _Memory:
    return _Memory()
