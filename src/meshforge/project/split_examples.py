"""Splits that a person showed, by `cut` and `split`, proposed for the hulls of other assets that look alike."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from meshforge import batch
from meshforge.batch.preparation.record import PreparationStep
from meshforge.common import MeshForgeError, format_share
from meshforge.formats import read
from meshforge.labels.split_lookalikes import SplitExample, SplitLookalikes, SplitProposal
from meshforge.project.span_splits import LIKELY, keep_shapes
from meshforge.store import SpanLine, SpanPart, SpansFile, SplitHull, Store, hull_digests
from meshforge.symbolic import SymbolicMesh

_DIGITS = 3


@dataclass(frozen=True, eq=False, slots=True)
class _ExampleStep:
    """A split that a person made in one step of an asset's preparation. labels: of its parts as they are now."""

    asset: str
    place: int
    entry: batch.Replacement
    labels: tuple[str, ...]

    @property
    def hull(self) -> SplitHull:
        """What was split."""
        return SplitHull(asset=self.asset, hull=self.entry.what, parts=tuple(self.entry.made))

    def to_json(self) -> list[object]:
        return [self.asset, self.place, self.entry.what, self.entry.source, self.entry.made, self.labels]


def has_split_examples(store: Store) -> bool:
    """Whether a person cut or split a hull of any asset."""
    return any(step.do in ("cut", "split") for asset in _list_prepared(store) for step in _read_steps(store, asset))


def propose_lookalikes(store: Store, meshes: Mapping[str, SymbolicMesh]) -> None:
    """Keep which hulls of some assets, by id, look like hulls that a person split, and their parts, where that is not
    known as things are.

    A split counts as soon as all its parts have labels, and not all the same one.
    """
    prepared = (asset for asset in _list_prepared(store) if asset in meshes)
    examples = [one for asset in prepared for one in _find_examples(store, meshes[asset], asset)]
    known = store.lookalike_spans()
    if not examples and not known.assets:
        return
    digests = {asset: hull_digests(mesh) for asset, mesh in meshes.items()}
    contact = store.settings.thresholds.contact
    rows = [batch.software_version(), contact, [one.to_json() for one in examples], digests]
    key = batch.text_digest(json.dumps(rows, sort_keys=True))
    if known.key == key:
        return
    parts = {asset: _list_parts(store, asset) for asset in meshes}
    finder, best = SplitLookalikes(meshes), dict[str, dict[str, tuple[_ExampleStep, SplitProposal]]]()
    for one in examples:
        split = _replay(store, one, contact)
        is_part = one.entry.what in parts[one.asset]
        for proposal in finder.find(split) if split else ():
            if (proposal.hull in parts[proposal.asset]) != is_part:  # what was split need not be split so again
                continue
            own = best.setdefault(proposal.asset, {})
            before = own.get(proposal.hull)
            if proposal.chance >= LIKELY and (before is None or proposal.chance > before[1].chance):
                own[proposal.hull] = one, proposal
    _keep(store, key, {asset: own for asset, own in best.items() if own}, digests)


def _keep(
    store: Store,
    key: str,
    best: Mapping[str, Mapping[str, tuple[_ExampleStep, SplitProposal]]],
    digests: Mapping[str, Mapping[str, str]],
) -> None:
    found = dict[str, dict[str, SpanLine]]()
    for asset, own in best.items():
        found[asset] = {hull: _to_line(*pair, digests[asset][hull]) for hull, pair in sorted(own.items())}
        shapes = {hull: own[hull][1].parts for hull in found[asset]}
        keep_shapes(store.layout.lookalike_parts(asset), found[asset], shapes)
    store.write_lookalike_spans(SpansFile(key=key, assets=found))


def _to_line(example: _ExampleStep, proposal: SplitProposal, geometry: str) -> SpanLine:
    chance = round(proposal.chance, _DIGITS)
    told = f"{proposal.hull} looks like {example.hull}, {format_share(chance)}"
    parts = tuple(SpanPart(label=label, share=chance) for label in example.labels)
    return SpanLine(geometry=geometry, chance=chance, told=told, parts=parts, like=example.hull)


def _list_prepared(store: Store) -> tuple[str, ...]:
    ids = set(store.assets())
    return tuple(asset for asset in store.layout.ids_with_preparation() if asset in ids)


def _read_steps(store: Store, asset: str) -> tuple[PreparationStep, ...]:
    """What was done to an asset; nothing where that is damaged, which the reader of the asset names."""
    try:
        return batch.read_steps(store.layout.preparation(asset)) or ()
    except MeshForgeError:
        return ()


def _list_parts(store: Store, asset: str) -> frozenset[str]:
    entries = (entry for step in _read_steps(store, asset) for entry in step.replaced if entry.kind == "hull")
    return frozenset(name for entry in entries for name in entry.made)


def _find_examples(store: Store, mesh: SymbolicMesh, asset: str) -> Iterator[_ExampleStep]:
    for place, step in enumerate(_read_steps(store, asset)):
        for entry in step.replaced if step.do in ("cut", "split") else ():
            labels = [mesh.hull_of(name).label if name in mesh.index else None for name in entry.made]
            named = tuple(label for label in labels if label)
            if entry.kind == "hull" and len(named) == len(labels) and len(set(named)) > 1:
                yield _ExampleStep(asset, place, entry, named)


def _replay(store: Store, example: _ExampleStep, contact: float | None) -> SplitExample | None:
    """A split with the asset as it was before; None where the asset cannot be read any more. contact: the threshold of
    the project, None for the language's own."""
    try:
        preparation = store.preparation(example.asset)
        before = preparation.with_only(preparation.steps[: example.place])
        mesh = SymbolicMesh.of(batch.apply_preparation(read(store.path(example.asset)), before))
    except MeshForgeError:
        return None
    mesh = mesh if contact is None else replace(mesh, epsilon=contact)
    if example.entry.what not in mesh.index:
        return None
    step = preparation.steps[example.place]
    plane = np.array([step.settings["at"], step.settings["across"]], dtype=float) if step.do == "cut" else None
    parts = tuple(preparation.hulls[digest] for digest in example.entry.made.values())
    return SplitExample(example.asset, example.entry.what, mesh, parts, plane)
