"""Decomposing what an asset has no hulls for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import MeshForgeError
from meshforge.geometry import Polytope
from meshforge.geometry.decompose import DecomposeSettings
from meshforge.preparation.engine import hulls_of, settings_record, software
from meshforge.preparation.fit import told_fit
from meshforge.preparation.record import Preparation, Replaced, Step, free_names, hull_digest
from meshforge.preparation.replay import Lost, fitting
from meshforge.preparation.sources import Source, sources, surface_digest
from meshforge.words import listed


@dataclass(frozen=True, eq=False, slots=True)
class Decomposed:
    """What became of an asset. made: what was decomposed now; failed: what could not be, and why.

    dropped: what an earlier preparation did and was given up, since it does not fit the asset any more.
    missed: where none of the names that it was limited to is there, a sentence on that.
    """

    preparation: Preparation
    made: tuple[Replaced, ...] = ()
    failed: tuple[Lost, ...] = ()
    dropped: tuple[Lost, ...] = ()
    missed: str | None = None


def decompose_asset(
    asset: Asset,
    before: Preparation,
    settings: DecomposeSettings,
    *,
    only: Sequence[str] = (),
    again: bool = False,
    hollow: bool = False,
    cache: Path | None = None,
) -> Decomposed:
    """Decompose all opaque pieces of an asset, and what bodies without collision geometry show.

    asset: as it was read; before: what is prepared already and stays as it is, as far as it still fits the asset;
    only: names, or patterns of them, of pieces and bodies, none for all; again: decompose anew what is decomposed;
    hollow: planar holes are not closed first, so that shells of one sheet are not filled.
    One piece that fails does not keep the others from being done.
    """
    fit = fitting(asset, _without(before, only) if again else before)
    kept = fit.preparation
    taken = {*(g.name for g in asset.geoms), *(o.name for o in asset.opaque), *kept.hull_digests}
    made: list[Replaced] = []
    hulls: list[Polytope] = []
    failed: list[Lost] = []
    bare = sources(fit.asset)
    missed = _missed(only, [*(source.what for source in bare), *kept.source_names])
    for source in bare:
        if not _chosen(source.what, only):
            continue
        try:
            entry, own = _decomposed(source, settings, taken, hollow, cache)
        except MeshForgeError as error:
            own_name = None if error.where == source.what else error.where  # the name of the piece comes with Lost
            failed.append(Lost(source.what, MeshForgeError(error.problem, where=own_name, remedy=error.remedy).message))
            continue
        made.append(entry)
        hulls += own
        taken |= entry.made.keys()
    if made:
        kept = kept.with_step(Step("decompose", settings_record(settings, hollow), software(settings), tuple(made)), hulls)
    return Decomposed(kept, tuple(made), tuple(failed), fit.lost, missed)


def _decomposed(
    source: Source, settings: DecomposeSettings, taken: set[str], hollow: bool, cache: Path | None
) -> tuple[Replaced, list[Polytope]]:
    notes: list[str] = []
    hulls = hulls_of(source.surface, settings, source.what, hollow=hollow, cache=cache, note=notes.append)
    names = free_names(source.base, len(hulls), taken)
    made = dict(zip(names, map(hull_digest, hulls), strict=True))
    told = "; ".join([told_fit(source.surface, hulls, solid=source.kind == "opaque" and not hollow), *notes])
    return Replaced(source.what, source.kind, surface_digest(source.surface), made, told), hulls


def _without(before: Preparation, only: Sequence[str]) -> Preparation:
    """What is prepared, without the decompositions that are to be done again."""
    kept = []
    for step in before.steps:
        stay = tuple(r for r in step.replaced if step.do != "decompose" or not _chosen(r.what, only))
        kept += [Step(step.do, step.settings, step.software, stay)] if stay else []
    return before.with_only(kept)


def _missed(only: Sequence[str], there: Sequence[str]) -> str | None:
    """A sentence where no piece or body that can be decomposed has a name that was asked for."""
    if any(_chosen(name, only) for name in there) or not only:
        return None
    known = f"it has {listed(there)}" if there else "it has none that can be decomposed"
    return f"no piece or body matches {listed(only)}: {known}"


def _chosen(name: str, only: Sequence[str]) -> bool:
    return not only or any(name == pattern or fnmatchcase(name, pattern) for pattern in only)
