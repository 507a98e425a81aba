"""Hulls for what an asset has none for, by a decomposition engine, and how well they fit what they were made of."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from fnmatch import fnmatchcase
from glob import escape
from importlib.metadata import version
from math import floor, inf
from pathlib import Path
from typing import Literal

import numpy as np

from meshforge import geometry
from meshforge.batch.lock import hold_lock
from meshforge.batch.preparation import record
from meshforge.checks import measure_kept_space
from meshforge.common import GeometryError, MeshForgeError, join_names, pluralize
from meshforge.formats import DecomposeBy, plain_part_name
from meshforge.geometry import CoacdSettings, DecomposeSettings, Floats, HullSettings, Polytope
from meshforge.symbolic import Asset, Surface

Concave = Literal["keep", "hull", "decompose"]
"""What is done with collision meshes that are not convex."""
_NEAR = 0.01  # of the diagonal: surface farther outside of all hulls than this is not covered
_POINTS = 4000
_LEAST = 0.005  # shares below count as none


@dataclass(frozen=True, eq=False, slots=True)
class DecompositionResult:
    """What became of an asset. made: what was decomposed now; failed: what could not be, and why.

    dropped: what an earlier preparation did and was given up, since it does not fit the asset any more.
    missed: where none of the names that it was limited to is there, a sentence on that.
    """

    preparation: record.Preparation
    made: tuple[record.Replacement, ...] = ()
    failed: tuple[record.PieceProblem, ...] = ()
    dropped: tuple[record.PieceProblem, ...] = ()
    missed: str | None = None


def decompose_asset(
    asset: Asset,
    before: record.Preparation,
    settings: DecomposeSettings,
    *,
    only: Sequence[str] = (),
    again: bool = False,
    hollow: bool = False,
    by: DecomposeBy = "whole",
    cache: Path | None = None,
    progress: Callable[[int, int], None] = lambda done, known: None,
) -> DecompositionResult:
    """Decompose all opaque pieces of an asset, and what bodies without collision geometry show.

    With `HullSettings` each collision element that is no hull is one, whatever the pieces that it was read as.

    asset: as it was read; before: what is prepared already and stays as it is, as far as it still fits the asset;
    only: names, or patterns of them, of pieces and bodies, none for all; again: decompose anew what is decomposed;
    hollow: planar holes are not closed first, so that shells of one sheet are not filled; by: `parts` decomposes each
    group, node and material by itself, where a file has several.
    progress: called with how many pieces are done, of how many.
    One piece that fails does not keep the others from being done.
    """
    fit = record.replay_preparation(asset, _drop_decompositions(before, only) if again else before)
    kept = fit.preparation
    taken = {*(g.name for g in asset.geoms), *(o.name for o in asset.non_convex), *kept.hull_digests}
    made: list[record.Replacement] = []
    hulls: list[Polytope] = []
    failed: list[record.PieceProblem] = []
    is_hull = isinstance(settings, HullSettings) and by == "whole"  # which stands for a whole element, as engines do it
    bare = record.find_sources(fit.asset, asset if is_hull else None)
    done = (entry.what for step in kept.steps for entry in step.replaced if entry.kind != "hull")
    missed = _describe_no_match(only, [*(source.what for source in bare), *done])
    chosen = [source for source in bare if matches_only(source.what, only)]
    for number, source in enumerate(chosen):
        progress(number, len(chosen))
        try:
            with _lock_copies(source, cache):
                entry, own = _decompose_source(source, settings, taken, hollow, by, cache)
        except MeshForgeError as error:
            own_name = None if error.where == source.what else error.where  # the name of the piece comes with Lost
            why = MeshForgeError(error.problem, where=own_name, remedy=error.remedy).message
            failed.append(record.PieceProblem(source.what, why))
            continue
        made.append(entry)
        hulls += own
        taken |= entry.made.keys()
    progress(len(chosen), len(chosen))
    if made:
        used = {"method": settings.engine, "hollow": hollow, **settings.as_dict(), "by": by}
        used |= {"only": list(only)} if only else {}
        step = record.PreparationStep("decompose", used, software_versions(settings), tuple(made))
        kept = kept.with_step(step, hulls)
    return DecompositionResult(kept, tuple(made), tuple(failed), fit.lost, missed)


def replace_concave(asset: Asset, how: Concave) -> Asset:
    """Return an asset with hulls in the place of its non-convex collision meshes; what has no triangles stays.

    how: `hull` makes one of each collision element that is not convex, as MuJoCo and Bullet do, `decompose` several by
    CoACD, `keep` none. Raises GeometryError naming a piece of which none can be made.
    """
    pieces = [piece for piece in asset.non_convex if piece.surface is not None and len(piece.surface.faces)]
    names = {piece.element if piece.element and how == "hull" else piece.name for piece in pieces}
    if how == "keep" or not names:
        return asset
    settings = HullSettings() if how == "hull" else CoacdSettings()
    only = [escape(name) for name in sorted(names)]
    done = decompose_asset(asset, record.Preparation(), settings, only=only, cache=geometry.cache_folder())
    for lost in done.failed:
        raise GeometryError(lost.why, where=lost.what)
    return record.apply_preparation(asset, done.preparation)


@contextmanager
def _lock_copies(source: record.DecompositionSource, cache: Path | None) -> Iterator[None]:
    """A lock by which of pieces with the same geometry one is decomposed; the others find its hulls in the cache."""
    with ExitStack() as stack:
        if cache is not None:
            with suppress(OSError):  # a cache that cannot be written
                lock = cache / "locks" / record.surface_digest(source.surface)[:2]
                stack.enter_context(hold_lock(lock, source.what, wait=inf))
        yield


def _decompose_source(
    source: record.DecompositionSource,
    settings: DecomposeSettings,
    taken: set[str],
    hollow: bool,
    by: DecomposeBy,
    cache: Path | None,
) -> tuple[record.Replacement, list[Polytope]]:
    notes = list[str]()
    surface = source.surface
    if by != "whole" and surface.parts and surface.parts.is_divided:
        found = geometry.decompose_by_parts(
            surface.vertices, surface.faces, surface.parts, settings, close=not hollow, cache=cache, note=notes.append
        )
        hulls = [one.hull for one in found]
        names = _name_by_parts(source.base, [surface.parts.names[one.part] for one in found], taken)
    else:
        hulls = decompose_surface(surface, settings, source.what, hollow=hollow, cache=cache, note=notes.append)
        is_free = source.kind == "element" and len(hulls) == 1 and source.base not in taken
        names = [source.base] if is_free else record.free_names(source.base, len(hulls), taken)
        notes += [] if by == "whole" else ["no parts are known, so it was decomposed as a whole"]
    made = dict(zip(names, map(record.hull_digest, hulls), strict=True))
    remark = "; ".join([describe_fit(source.surface, hulls), *notes])
    return record.Replacement(source.what, source.kind, record.surface_digest(source.surface), made, remark), hulls


def _name_by_parts(base: str, parts: Sequence[str], taken: set[str]) -> list[str]:
    """The names of hulls by their parts, `door/handle#0`, numbers that are taken left out; base: `door/geom0`."""
    body, slash, _ = base.rpartition("/")
    known, names = set(taken), list[str]()
    for part in parts:
        names += record.free_names(f"{body}{slash}{plain_part_name(part)}", 1, known)
        known.add(names[-1])
    return names


def _drop_decompositions(before: record.Preparation, only: Sequence[str]) -> record.Preparation:
    kept = []
    for step in before.steps:
        stay = tuple(r for r in step.replaced if step.do != "decompose" or not matches_only(r.what, only))
        kept += [record.PreparationStep(step.do, step.settings, step.software, stay)] if stay else []
    return before.with_only(kept)


def _describe_no_match(only: Sequence[str], there: Sequence[str]) -> str | None:
    """A sentence where no piece or body that can be decomposed has a name that was asked for."""
    if any(matches_only(name, only) for name in there) or not only:
        return None
    known = f"it has {join_names(there)}" if there else "it has none that can be decomposed"
    return f"no piece or body matches {join_names(only)}: {known}"


def matches_only(name: str, only: Sequence[str]) -> bool:
    """Return whether a piece or body is one of these names or patterns; all are where there are none."""
    return not only or any(name == pattern or fnmatchcase(name, pattern) for pattern in only)


def decompose_surface(
    surface: Surface,
    settings: DecomposeSettings,
    name: str,
    *,
    hollow: bool,
    cache: Path | None,
    note: Callable[[str], None],
) -> list[Polytope]:
    """Return the convex hulls of a surface, in the engine's order. Raises GeometryError, about `name`.

    hollow: planar holes stay open, so that shells of one sheet are not filled.
    """

    def run(vertices: Floats, faces: geometry.Ints) -> list[Polytope]:
        return geometry.decompose(vertices, faces, settings, close=not hollow, cache=cache, note=note)

    if geometry.is_sheet(surface.vertices[surface.faces].reshape(-1, 3)):
        note("it is flat, so its hulls are thin sheets")
        return geometry.sheet_hulls(surface.vertices, surface.faces, run, name)
    return run(surface.vertices, surface.faces)


def software_versions(settings: DecomposeSettings | None = None) -> dict[str, str]:
    """Return the versions of what makes hulls."""
    return {name: version(name) for name in ("meshforge", settings.package if settings else "manifold3d")}


def describe_fit(surface: Surface, hulls: Sequence[Polytope]) -> str:
    """Return `12 hulls, 97% of the free space stays free, 2% of the surface outside`; see
    `checks.measure_kept_space`."""
    parts = [pluralize(len(hulls), "hull")]
    kept = measure_kept_space(surface, hulls)
    parts += [] if kept is None else [f"{floor(100 * kept)}% of the free space stays free"]
    bare = measure_uncovered(surface, hulls)
    parts += [f"{bare:.0%} of the surface outside"] if bare >= _LEAST else []
    return ", ".join(parts)


def measure_uncovered(surface: Surface, hulls: Sequence[Polytope]) -> float:
    """Return the share of a surface's area that is farther outside of all hulls than 1% of its diagonal."""
    points, _ = geometry.sample_surface(surface.vertices, surface.faces, _POINTS)
    reach = _NEAR * float(np.linalg.norm(np.ptp(points, axis=0)))
    outside = np.ones(len(points), dtype=bool)
    for hull in hulls:
        outside[outside] = geometry.heights_above(points[outside], hull) > reach
    return float(outside.mean())
