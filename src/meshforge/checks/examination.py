"""All checks of one mesh: `check`, which costs little, and all else that can be measured, as far as it is asked for;
and pictures of what was measured."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from meshforge.checks.clearance import Clearance, measure_clearance
from meshforge.checks.engine_trial import EngineTrial
from meshforge.checks.fit import LEAST_GAP_SHARE, FitGroup, MeshFit, measure_fit
from meshforge.checks.legality import check_legality, find_oddities
from meshforge.checks.physics.simulation import Physics, simulate
from meshforge.checks.registry import CHECKS, MEASURES, run_checks
from meshforge.common import UsageError, suggest_among
from meshforge.engines import ENGINES, Finding, check_limits, find_engine
from meshforge.geometry import Floats, Ints
from meshforge.rendering import LengthUnit, draw_heat_map, draw_volumes
from meshforge.symbolic import Surface, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image


REFUSED = "MuJoCo refuses this file"
"""How a note begins on an MJCF that was read for its collision geometry only."""
NO_VISUAL_MESH = "nothing is shown (no visual mesh), so clearance and fit have nothing to be measured against"


@dataclass(frozen=True, slots=True)
class CheckOptions:
    """What is measured besides legality; engine: whose limits; cell: of the grids of clearance and fit [m].

    plugins: names of checks of plug-ins.
    """

    engine: str | None = None
    fit: bool = False
    clearance: bool = False
    physics: bool = False
    cell: float | None = None
    plugins: tuple[str, ...] = ()

    @property
    def is_costly(self) -> bool:
        """Whether anything is measured that takes its time."""
        return self.fit or self.clearance or self.physics or bool(self.plugins)

    def with_checks(self, names: Iterable[str]) -> CheckOptions:
        """The same and further checks, by the names of measurements, of one engine, and of plug-ins.

        Raises UsageError for a name that is not known, or a second engine; PluginError for a plug-in that cannot be
        loaded.
        """
        options = self
        for name in dict.fromkeys(names):
            if name in MEASURES:
                chosen: dict[str, Any] = {name: True}
                options = replace(options, **chosen)
            elif name in ENGINES:
                if options.engine not in (None, name):
                    raise UsageError(f"two engines: {options.engine}, {name}", remedy="Choose one of them.")
                options = replace(options, engine=name)
            elif CHECKS.get(name):
                options = replace(options, plugins=tuple(dict.fromkeys([*options.plugins, name])))
            else:
                known = (*MEASURES, *ENGINES, *CHECKS)
                raise UsageError(f"there is no check {name!r}", remedy=suggest_among(name, known, "There are"))
        return options


@dataclass(frozen=True, eq=False, slots=True)
class Examination:
    """What was measured of a mesh, None for what was not asked for or could not be.

    changed: what its hulls closed and opened of the space between the hulls before; earlier: physics of those.
    trial: what the hulls were held against, where the limits of an engine were asked for.
    """

    findings: tuple[Finding, ...]
    fit: MeshFit | None = None
    clearance: Clearance | None = None
    changed: Clearance | None = None
    physics: Physics | None = None
    earlier: Physics | None = None
    notes: tuple[str, ...] = ()
    trial: EngineTrial | None = None

    def add_trial(self, trial: EngineTrial) -> Examination:
        """The same with what an engine itself said."""
        return replace(self, findings=(*trial.findings, *self.findings), trial=trial)

    def add_notes(self, notes: Iterable[str]) -> Examination:
        """The same with more notes, but for what its trial has said in a finding."""
        refused = self.trial is not None and self.trial.refusal is not None
        more = (note for note in notes if not (refused and note.startswith(REFUSED)))
        return replace(self, notes=(*self.notes, *more))

    @property
    def has_failed(self) -> bool:
        """Whether a finding is an error."""
        return any(finding.severity == "error" for finding in self.findings)

    def __str__(self) -> str:
        """What was measured and what is wrong, line by line; `legal` where there is nothing else to say."""
        lines = [*self.descriptions, *map(str, self.findings)]
        if not self.findings and len(lines) == bool(self.trial):
            return f"legal{f' ({self.trial.description})' if self.trial else ''}"
        return "\n".join(lines)

    @property
    def descriptions(self) -> tuple[str, ...]:
        """What was measured, a sentence each."""
        found = [f"fit: {self.fit.description}"] if self.fit and self.fit.hulls else []
        found += [f"clearance: {c.description}" for c in (self.clearance, self.changed) if c]
        found += [f"physics: {self.physics.description}"] if self.physics else []
        found += [f"physics before: {self.earlier.description}"] if self.earlier else []
        found += [f"engine: {self.trial.description}"] if self.trial and self.trial.description else []
        return (*found, *(f"note: {note}" for note in self.notes))

    def to_json(self) -> dict[str, Any]:
        """The measures as JSON-able data, without the findings; what was not measured is left out."""
        parts = {
            "fit": self.fit,
            "clearance": self.clearance,
            "clearance_of_edit": self.changed,
            "physics": self.physics,
            "physics_before": self.earlier,
        }
        notes = {"notes": list(self.notes)} if self.notes else {}
        trial = {"engine": self.trial.to_json()} if self.trial else {}
        return trial | {name: part.to_json() for name, part in parts.items() if part is not None} | notes


def examine_mesh(mesh: SymbolicMesh, wanted: CheckOptions, before: SymbolicMesh | None = None) -> Examination:
    """Measure a mesh; before: the mesh that it was edited from, whose visual mesh counts then.

    Hulls that are not legal are left out of all but the first findings. Raises UsageError for an unknown engine.
    """
    findings = list(check(mesh, wanted.engine))
    if not wanted.is_costly:
        return Examination(tuple(findings))
    findings += run_checks(wanted.plugins, mesh, before)
    sound = _without_illegal_hulls(_with_visuals_of(mesh, before))
    was = _without_illegal_hulls(before) if before else None
    notes = []
    found = measure_fit(sound, cell=wanted.cell) if wanted.fit else None
    space = measure_clearance(sound, cell=wanted.cell) if wanted.clearance else None
    edit = measure_clearance(sound, was, cell=wanted.cell) if wanted.clearance and was and was.hulls else None
    if (found is not None and not found.hulls) or (wanted.clearance and space is None):
        notes.append(NO_VISUAL_MESH)
    elif found is not None and found.silent:
        notes.append(f"bodies that show nothing, so their fit was not measured: {', '.join(found.silent)}")
    rested = simulate(mesh) if wanted.physics else None
    earlier = simulate(before) if wanted.physics and before else None
    findings += find_oddities(sound) if wanted.fit else ()
    for part in (found, space, edit, rested):
        findings += part.findings if part else ()
    return Examination(tuple(findings), found, space, edit, rested, earlier, tuple(notes))


def _with_visuals_of(mesh: SymbolicMesh, before: SymbolicMesh | None) -> SymbolicMesh:
    """The mesh with what was shown before: where collision geometry is what is shown, an edit changes that, too."""
    if before is None or before.asset is None or mesh.asset is None:
        return mesh
    return replace(mesh, asset=replace(mesh.asset, visuals=before.asset.visuals))


def _without_illegal_hulls(mesh: SymbolicMesh) -> SymbolicMesh:
    faulty, _ = check_legality(mesh)
    return mesh.with_hulls(hull for hull in mesh.hulls if hull.name not in faulty) if faulty else mesh


def check(mesh: SymbolicMesh, engine: str | None = None) -> tuple[Finding, ...]:
    """What is not legal in a mesh, and with an engine, what is beyond its limits; empty where all is well.

    Raises UsageError for an engine that is not known.
    """
    known = None if engine is None else find_engine(engine)
    faulty, findings = check_legality(mesh)
    return findings if known is None else (*findings, *check_limits(known, mesh, faulty))


COLORS = {"closed": "#D64545", "opened": "#3B7DD8"}


def draw_examination(
    mesh: SymbolicMesh, found: Examination, size: tuple[int, int] = (640, 480), unit: LengthUnit = "m"
) -> Iterator[tuple[str, str, Image]]:
    """A name for a file, a line of text and a picture each: heat maps of the fit, and what was closed and opened.

    unit: of the legends; the lines have metres and litres.
    """
    maps = draw_fit(mesh, found.fit, size, unit) if found.fit else None
    if maps and found.fit:
        yield "fit-out", f"hulls stick out by {found.fit.out:.3g} m at most", maps[0]
        yield "fit-bare", f"visual mesh, {found.fit.bare:.3g} m off all hulls at most", maps[1]
    for name, part in (("clearance", found.clearance), ("clearance-of-edit", found.changed)):
        if part and part.regions:
            text = f"{part.reference}: {part.closed:.3g} l closed, {part.opened:.3g} l opened"
            marked = [(region.kind, COLORS[region.kind], region.surface) for region in part.regions]
            yield name, text, draw_volumes(mesh, marked, size=size, title=f"space about the {part.reference}")


def draw_fit(
    mesh: SymbolicMesh, found: MeshFit, size: tuple[int, int] = (640, 480), unit: LengthUnit = "m"
) -> tuple[Image, Image] | None:
    """Two pictures: the hulls by how far they stick out, and the visual mesh by how far it lies off all hulls.

    None where nothing is shown. The strongest colour is for twice the length that matters; what is below a cell has
    none.
    """
    if not found.groups:
        return None
    most = max(2 * LEAST_GAP_SHARE * found.diagonal, 4 * found.cell)
    hulls = [hull.shape.tessellate() for group in found.groups for hull in group.hulls]
    corners = [group.visual_surface.corners for group in found.groups]
    seen = [Surface(c.reshape(-1, 3), np.arange(3 * len(c)).reshape(-1, 3)) for c in corners]
    group_of = np.array([k for k, group in enumerate(found.groups) for _ in group.hulls])

    def out(points: Floats, items: Ints) -> Floats:
        return _measure_by_group(found.groups, points, group_of[items], FitGroup.measure_out)

    def bare(points: Floats, items: Ints) -> Floats:
        return _measure_by_group(found.groups, points, items, lambda group, some: group.measure_bare(some)[0])

    titles = "hulls: how far they stick out", "visual mesh: how far off all hulls"
    return (
        draw_heat_map(mesh, hulls, out, most, size=size, title=titles[0], unit=unit),
        draw_heat_map(mesh, seen, bare, most, size=size, title=titles[1], unit=unit),
    )


def _measure_by_group(
    groups: Sequence[FitGroup], points: Floats, which: Ints, measure: Callable[[FitGroup, Floats], Floats]
) -> Floats:
    """What `measure` gives for each point (n, 3) by the group (n,) that it belongs to."""
    values = np.zeros(len(points))
    for k in np.unique(which):
        values[which == k] = measure(groups[k], points[which == k])
    return values
