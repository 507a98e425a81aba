"""What a project says about preparing new assets, and which of its own are new.

How pieces are decomposed is read from the preparations of its assets, so that nothing can get out of step with them;
that bodies are rebuilt, and from when an asset is new, is kept when all assets are prepared.
"""

import json
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, get_args

from meshforge import batch
from meshforge.common import MeshForgeError, join_names
from meshforge.formats import DecomposeBy
from meshforge.geometry import CoacdSettings, DecomposeSettings, PieceEngine
from meshforge.store import PreparationPlanFile, Store, read_json, write_json

_EXAMPLES = 2  # assets that are named where they were decomposed otherwise


@dataclass(frozen=True, slots=True)
class DecompositionPlan:
    """One decomposition: its settings, and the further arguments of `batch.decompose_asset`."""

    settings: DecomposeSettings
    only: tuple[str, ...] = ()
    hollow: bool = False
    by: DecomposeBy = "whole"


@dataclass(frozen=True, slots=True)
class RebuildSettings:
    """How bodies are rebuilt of which hulls span parts. min_confidence: the probability of that, from which they are;
    pieces: the engine of the fine pieces that they are made of; only: names of hulls and bodies, or patterns of them,
    none for all."""

    min_confidence: float = 0.9
    pieces: PieceEngine = "coacd"
    only: tuple[str, ...] = ()


REBUILD_DEFAULTS = RebuildSettings()


@dataclass(frozen=True, slots=True)
class PreparationPlan:
    """How new assets of a family are prepared.

    decompose: in this order, as all assets were that have been decomposed; rebuild: how bodies are of which hulls span
    parts, None where these are not looked for; unclear: a sentence where assets were decomposed in several ways,
    so that new ones are not.
    """

    decompose: tuple[DecompositionPlan, ...] = ()
    rebuild: RebuildSettings | None = None
    unclear: str | None = None


def read_preparation_plan(store: Store) -> PreparationPlan:
    """Return what a project says about new assets. Raises ProjectError where its file is damaged."""
    kept = _read(store)
    known = kept.min_confidence
    rebuild = None if known is None else RebuildSettings(known, kept.pieces, kept.only)
    ways = dict[str, list[str]]()
    for asset in store.layout.preparation.ids:
        if asset not in store.found.ids:
            continue
        try:
            steps = batch.read_steps(store.layout.preparation(asset)) or ()
        except MeshForgeError:  # the run says so of that asset
            continue
        done = [json.dumps(step.settings, sort_keys=True) for step in steps if step.do == "decompose"]
        if done:  # what was continued was done once
            ways.setdefault("\n".join(dict.fromkeys(done)), []).append(asset)
    if len(ways) > 1:
        some = "; ".join(join_names(assets, _EXAMPLES) for assets in ways.values())
        problem = f"the assets were decomposed in {len(ways)} ways, so new ones are not decomposed ({some})"
        return PreparationPlan(rebuild=rebuild, unclear=problem)
    lines = next(iter(ways), "").splitlines()
    plans = [_parse_plan(json.loads(line)) for line in lines]
    if None in plans:
        problem = "the assets were decomposed by another version, with other options, so new ones are not decomposed"
        return PreparationPlan(rebuild=rebuild, unclear=problem)
    return PreparationPlan(tuple(plan for plan in plans if plan), rebuild)


def _parse_plan(settings: Mapping[str, Any]) -> DecompositionPlan | None:
    """A decomposition by the settings that a step keeps; None where this version does not know them."""
    kind = next((one for one in get_args(DecomposeSettings) if one.engine == settings.get("method")), CoacdSettings)
    known = {field.name for field in fields(kind)}
    values = {name: value for name, value in settings.items() if name in known}
    rest = {name: value for name, value in settings.items() if name not in known}
    if rest.pop("method", None) != kind.engine or rest.keys() - {"hollow", "by", "only"}:
        return None
    try:
        own = kind(**values)
    except (MeshForgeError, TypeError):
        return None
    by: DecomposeBy | None = next((way for way in get_args(DecomposeBy) if way == rest.get("by", "whole")), None)
    return by and DecompositionPlan(own, tuple(rest.get("only", ())), bool(rest.get("hollow")), by)


def keep_decomposed(store: Store, assets: Collection[str]) -> None:
    """Keep that pieces of these assets were decomposed, where they are all of the project."""
    if set(store.assets()) <= set(assets):
        _change(store, {"decomposed": store.assets()})


def keep_rebuilt(store: Store, assets: Collection[str], how: RebuildSettings) -> None:
    """Keep how bodies of these assets were rebuilt, where they are all of the project."""
    if set(store.assets()) <= set(assets):
        _change(store, {"rebuilt": store.assets(), **asdict(how)})


def extend_plan(store: Store, assets: Collection[str], *, decomposed: bool, rebuilt: bool) -> None:
    """Keep that assets which came later were prepared as the others; decomposed, rebuilt: whether their pieces were
    decomposed, and whether their hulls were looked at."""
    kept = _read(store)
    lists = {"decomposed": kept.decomposed if decomposed else None, "rebuilt": kept.rebuilt if rebuilt else None}
    values = {name: tuple(dict.fromkeys([*ids, *assets])) for name, ids in lists.items() if ids is not None}
    _change(store, values)


def read_dismissed(store: Store) -> Mapping[str, Collection[str]]:
    """Return the hulls of each asset that a person said span no parts."""
    return _read(store).dismissed


def dismiss_spanning(store: Store, hulls: Mapping[str, Collection[str]]) -> None:
    """Keep that these hulls, by asset, span no parts: they are not found again."""
    with store.lock():
        before = read_dismissed(store)
        added = {asset: tuple(sorted({*before.get(asset, ()), *names})) for asset, names in hulls.items()}
        _change(store, {"dismissed": {**before, **added}})


def read_piece_engine(store: Store) -> PieceEngine:
    """Return the engine of the fine pieces by which the hulls of all assets were looked at last, else CoACD."""
    return _read(store).pieces


def forget_plan(store: Store) -> None:
    """Let new assets be as they are: nothing of all that was prepared is kept."""
    with store.lock():
        store.layout.preparation_plan.unlink(missing_ok=True)


def _change(store: Store, values: Mapping[str, Any]) -> None:
    with store.lock():
        kept = _read(store)
        after = kept.model_copy(update=dict(values))
        if after != kept:
            write_json(store.layout.preparation_plan, after)


def find_new_assets(store: Store) -> tuple[dict[str, PreparationPlan], str | None]:
    """Return the assets that came after the others were prepared, with what is to be done to each; and why they are not
    decomposed, where that is unclear. Raises ProjectError where the project's file is damaged."""
    kept = _read(store)
    every = frozenset(store.assets())
    whole = every - set(every if kept.decomposed is None else kept.decomposed)
    rebuilt = every - set(every if kept.rebuilt is None else kept.rebuilt)
    if not whole and not rebuilt:
        return {}, None
    plan = read_preparation_plan(store)
    found = {
        asset: PreparationPlan(plan.decompose if asset in whole else (), plan.rebuild if asset in rebuilt else None)
        for asset in store.assets()
        if asset in whole or asset in rebuilt
    }
    return {asset: own for asset, own in found.items() if own != PreparationPlan()}, plan.unclear if whole else None


def _read(store: Store) -> PreparationPlanFile:
    return read_json(store.layout.preparation_plan, PreparationPlanFile) or PreparationPlanFile()
