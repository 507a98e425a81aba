"""Measures one output beside its asset: the findings of checks, and figures before and after."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

from meshforge import checks
from meshforge.batch import Stamp, has_same_files, read_stamp, record_digest, software_version, text_digest
from meshforge.common import ProjectError
from meshforge.engines import ENGINES
from meshforge.formats import load
from meshforge.project import Project, output_digest
from meshforge.store import NotHereError
from meshforge.studio.wire.asset import CheckFinding, CheckPart, CheckResult, Figure, FigureUnit
from meshforge.symbolic import SymbolicMesh

_RULE_PREFIXES = {"fit": ("fit-", "shape-"), "clearance": ("clearance-",), "physics": ("physics-",)}
Value = TypeVar("Value")

_REMEDY = "Apply the program to it again."

_VERSION = "1"
"""To be raised when outputs are measured in another way."""


def measure(pair: OutputPair, part: CheckPart) -> CheckResult:
    """Return one part of what `meshforge check OUTPUT --against ASSET` reports."""
    if part == "engines":
        return _check_engines(pair)
    now = checks.examine_mesh(pair.after, checks.CheckOptions((part,)), pair.before)
    if part == "physics":
        earlier = now.get(checks.BEFORE, checks.Physics)
        return _to_checked(part, earlier.findings if earlier else (), now, physics_figures(now), None)
    was = checks.examine_mesh(pair.before, checks.CheckOptions((part,)))
    if part == "fit":
        fit = _fit_of(now)
        return _to_checked(part, was.findings, now, fit_figures(was, now), fit.cell if fit else None)
    space = now.get("clearance", checks.Clearance) or now.get(checks.OF_EDIT, checks.Clearance)
    return _to_checked(part, was.findings, now, clearance_figures(was, now), space.cell if space else None)


def _to_checked(
    part: CheckPart,
    before: Iterable[checks.Finding],
    now: checks.Examination,
    rows: Iterable[Figure],
    cell: float | None,
) -> CheckResult:
    figures = tuple(rows)
    found = [f for f in now.findings if f.rule.startswith(_RULE_PREFIXES[part])]
    old = [f for f in before if f.rule.startswith(_RULE_PREFIXES[part])]
    edit = now.get(checks.OF_EDIT, checks.Clearance)
    by_edit = edit.findings if edit else ()
    gone = {finding.rule for finding in old} - {finding.rule for finding in found}
    physics = (("", now.get("physics", checks.Physics)), ("before the edit ", now.get(checks.BEFORE, checks.Physics)))
    no_rest = (f"{when}{p.description}" for when, p in physics if p and p.rest is None)
    return CheckResult(
        part=part,
        figures=figures,
        findings=tuple(_to_row(f, None, f in by_edit or not _was_there(f, old)) for f in found),
        gone=len(gone),
        notes=(*now.notes, *no_rest),
        cell=cell,
        pictured=cell is not None,
    )


def _check_engines(pair: OutputPair) -> CheckResult:
    rows = []
    for engine in (None, *ENGINES):
        known = _findings_of(pair.before, engine)
        rows += [_to_row(f, engine, not _was_there(f, known)) for f in _findings_of(pair.after, engine)]
    return CheckResult(part="engines", findings=tuple(rows))


def _findings_of(mesh: SymbolicMesh, engine: str | None) -> list[checks.Finding]:
    """The limits of an engine that are exceeded; without an engine, what is not legal."""
    return [found for found in checks.check(mesh, engine) if engine is None or found.rule.startswith(f"{engine}-")]


def _to_row(found: checks.Finding, engine: str | None, new: bool) -> CheckFinding:
    return CheckFinding(
        rule=found.rule,
        severity=found.severity,
        engine=engine,
        new=new,
        hulls=found.hulls,
        text=found.message,
        remedy=found.remedy,
    )


def _was_there(found: checks.Finding, before: Iterable[checks.Finding]) -> bool:
    return any(old.rule == found.rule and set(found.hulls) <= set(old.hulls) for old in before)


def _fit_of(found: checks.Examination) -> checks.MeshFit | None:
    fit = found.get("fit", checks.MeshFit)
    return fit if fit and fit.hulls else None


def fit_figures(was: checks.Examination, now: checks.Examination) -> Iterator[Figure]:
    """Yield how far hulls stick out, and what they leave uncovered."""
    before, after = _fit_of(was), _fit_of(now)
    if after is None:
        return
    yield _make_figure("Hulls stick out, at most", "m", before, after, lambda fit: fit.out)
    yield _make_figure("Visual surface uncovered", "%", before, after, lambda fit: 100 * fit.bare_share)
    yield _make_figure("It lies off hulls, at most", "m", before, after, lambda fit: fit.bare)


def clearance_figures(was: checks.Examination, now: checks.Examination) -> Iterator[Figure]:
    """Yield how much of the space about the visual mesh hulls close and open; then what the edit closed and opened."""
    for key, what in (("clearance", ", against the visual"), (checks.OF_EDIT, " by the edit")):
        before, after = was.get(key, checks.Clearance), now.get(key, checks.Clearance)
        if after:
            yield _make_figure(f"Closed{what}", "l", before, after, lambda c: c.closed)
            yield _make_figure(f"Opened{what}", "l", before, after, lambda c: c.opened)


def physics_figures(now: checks.Examination) -> Iterator[Figure]:
    """Yield how the asset rests, and which bodies overlap."""
    physics, earlier = now.get("physics", checks.Physics), now.get(checks.BEFORE, checks.Physics)
    was, rest = earlier.rest if earlier else None, physics.rest if physics else None
    if rest is not None:
        yield _make_figure("Shakes at rest", "m/s", was, rest, lambda r: r.jitter)
        yield _make_figure("Turned", "°", was, rest, lambda r: r.tilt)
        yield _make_figure("Wandered", "m", was, rest, lambda r: r.moved)
        yield _make_figure("Mass", "kg", was, rest, lambda r: r.mass)
    if physics and (rest is not None or physics.overlaps):
        yield _make_figure("Overlaps of bodies", "", earlier, physics, lambda found: len(found.overlaps))
        if any(found.overlaps for found in (earlier, physics) if found):
            yield _make_figure(
                "Deepest of them",
                "m",
                earlier,
                physics,
                lambda found: max((overlap.depth for overlap in found.overlaps), default=0.0),
            )


def _make_figure(
    what: str, unit: FigureUnit, before: Value | None, after: Value | None, of: Callable[[Value], float]
) -> Figure:
    values = [None if found is None else float(of(found)) for found in (before, after)]
    return Figure(what=what, unit=unit, before=values[0], after=values[1])


@dataclass(frozen=True, slots=True)
class MeasureTask:
    """The work of a worker; project: with this asset alone; key: the digest of the output that is meant."""

    project: Project
    asset: str
    key: str


@dataclass(frozen=True, eq=False, slots=True)
class OutputPair:
    """An asset as it is prepared, and its output."""

    before: SymbolicMesh
    after: SymbolicMesh


def read_pair(work: MeasureTask) -> OutputPair:
    """Read both meshes. Raises NotHereError where the output is another by now, ProjectError where one of them changed
    since the output was written, AssetError where one cannot be read."""
    project, asset = work.project, work.asset
    stamp = read_stamp(project.layout.edited, asset)
    if stamp is None or check_key(stamp) != work.key:
        raise NotHereError("its output is another by now", where=asset, remedy="Look at the present one.")
    if not _is_unchanged(project, asset, stamp):
        raise ProjectError("the asset changed since its output was made", where=asset, remedy=_REMEDY)
    if not stamp.is_whole(project.layout.edited):
        raise ProjectError("files of its output are gone or changed", where=asset, remedy=_REMEDY)
    before, after = project.mesh(asset), load(project.layout.edited / stamp.out)
    return OutputPair(before, after.with_view_up(before.asset.view_up) if before.asset else after)


def _is_unchanged(project: Project, asset: str, stamp: Stamp) -> bool:
    made = stamp.inputs
    if made is None or record_digest(project.layout.preparation(asset)) != made.preparation:
        return False
    path = project.path(asset)
    return has_same_files(made.asset, path, project.every.base_of(path))


def check_key(stamp: Stamp | None) -> str | None:
    """Return a digest of the files of an output and of the asset it was made from, None where there is no output."""
    output = output_digest(stamp)
    if stamp is None or stamp.inputs is None or output is None:
        return None
    files = [f"{name} {digest}" for name, digest in sorted(stamp.inputs.asset.items())]
    return text_digest("\n".join([_VERSION, software_version(), output, str(stamp.inputs.preparation), *files]))
