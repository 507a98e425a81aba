"""Hulls that look like others: assets are described in worker processes on request, and stay described until they
change, so that each question is answered at once.
"""

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from threading import Lock

import numpy as np

from meshforge.batch import record_digest, source_files
from meshforge.common import FileStates, MeshForgeError, StoppedError, file_states
from meshforge.geometry import Floats, Ints
from meshforge.label_model import FamilyTable, MeshDescriber, find_similar
from meshforge.label_model.similar import OTHER_STEPS, OWN_STEPS, Bools
from meshforge.project import Project
from meshforge.store import AssetFiles, NotHereError
from meshforge.studio.wire.requests import HullsOfAsset, SimilarRequest, SimilarView
from meshforge.studio.workers import Workers, wait_for
from meshforge.symbolic import HUMAN_SOURCES, Label

MOST_ASSETS = 400
"""Assets that are looked in; evenly chosen of more."""


@dataclass(frozen=True, eq=False, slots=True)
class _HullRows:
    """The hulls of an asset by name, and their rows as `MeshDescriber` makes them."""

    names: tuple[str, ...]
    rows: Floats


@dataclass(frozen=True, eq=False, slots=True)
class _Entry:
    """An asset that is or will be described. times, record, contact: of what it was made from."""

    times: FileStates
    record: str | None
    contact: float | None
    future: Future[_HullRows]

    def is_current(self, record: str | None, contact: float | None) -> bool:
        """Whether it still holds; what failed is tried again."""
        same = (self.record, self.contact) == (record, contact) and file_states(self.times) == self.times
        failed = self.future.done() and (self.future.cancelled() or self.future.exception() is not None)
        return same and not failed


class SimilarHulls:
    """Finds hulls that look alike in the assets of a project."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._lock = Lock()
        self._entries: dict[str, _Entry] = {}

    def prepare(self, project: Project, assets: Iterable[str]) -> None:
        """Start to describe assets, so that what is asked later need not wait."""
        for asset in assets:
            self._describe(project, asset)

    def find(self, project: Project, readable: Sequence[str], request: SimilarRequest) -> SimilarView:
        """Return hulls that look like some. readable: the assets of the project that can be looked in.

        Raises NotHereError for a hull that is not there, AssetError where its asset cannot be read.
        """
        homes = tuple(dict.fromkeys(one.asset for one in request.hulls))
        present = set(readable)
        wanted = [asset for asset in request.assets or readable if asset in present]
        chosen = choose_assets(homes, wanted)
        described, unread = self._describe_all(project, homes, chosen)
        passed_over = len(set(wanted) - set(chosen)) if request.assets else 0
        if not homes:
            return SimilarView(found=(), step=0, more=False, unread=unread, passed_over=passed_over)
        hulls = _find_places(described, request)
        none = np.zeros((0, 2), dtype=np.int64)
        table = FamilyTable.of([(one.rows, none) for one in described.values()])
        excluded = _find_excluded(project, described, hulls)
        others = None if request.assets is None else np.arange(len(described))
        found, step = find_similar(table, np.unique(hulls), excluded, others, request.step)
        last = len(OWN_STEPS if others is None else OTHER_STEPS) - 1
        return SimilarView(
            found=_group(described, found), step=step, more=step < last, unread=unread, passed_over=passed_over
        )

    def _describe_all(
        self, project: Project, homes: Iterable[str], assets: Iterable[str]
    ) -> tuple[Mapping[str, _HullRows], tuple[str, ...]]:
        """Assets as they are described, and those that cannot be. Raises MeshForgeError where one of `homes` cannot."""
        futures = {asset: self._describe(project, asset) for asset in (*homes, *assets)}
        needed, found, unread = set(homes), dict[str, _HullRows](), list[str]()
        for asset, future in futures.items():
            try:
                found[asset] = wait_for(future)
            except StoppedError:
                raise
            except MeshForgeError:
                if asset in needed:
                    raise
                unread.append(asset)
        return found, tuple(unread)

    def _describe(self, project: Project, asset: str) -> Future[_HullRows]:
        (files,) = project.asset_files([asset])
        record = record_digest(files.preparation)
        with self._lock:
            known = self._entries.get(asset)
            if known and known.is_current(record, files.contact):
                return known.future
            times = file_states([*source_files(files.path), files.path])
            future = self._workers.start(_describe_asset, files)
            self._entries[asset] = _Entry(times, record, files.contact, future)
        return future


def choose_assets(first: Sequence[str], assets: Sequence[str], most: int = MOST_ASSETS) -> tuple[str, ...]:
    """Return some assets with those that come first, evenly chosen where there are too many."""
    rest = [asset for asset in assets if asset not in set(first)]
    room = max(most - len(first), 0)
    if len(rest) > room:
        rest = [rest[k * len(rest) // room] for k in range(room)]
    return (*first, *rest)


def _describe_asset(files: AssetFiles) -> _HullRows:
    mesh = files.read_mesh()
    return _HullRows(tuple(hull.name for hull in mesh.hulls), MeshDescriber(mesh).describe().rows)


def _find_excluded(project: Project, described: Mapping[str, _HullRows], hulls: Iterable[int]) -> Bools:
    """The hulls that a person gave a label that none of some hulls has (n,)."""
    given: list[str | None] = []
    for asset, one in described.items():
        labels = project.labels(asset).labels
        given += [_name_given(labels.get(name)) for name in one.names]
    allowed = {given[place] for place in hulls}
    return np.array([name is not None and name not in allowed for name in given], dtype=np.bool_)


def _name_given(label: Label | None) -> str | None:
    return label.name if label and label.source in HUMAN_SOURCES else None


def _find_places(described: Mapping[str, _HullRows], request: SimilarRequest) -> list[int]:
    """Where the hulls of a request are among those of all assets. Raises NotHereError."""
    rows = ((asset, name) for asset, one in described.items() for name in one.names)
    places = {row: place for place, row in enumerate(rows)}
    for one in request.hulls:
        if (one.asset, one.hull) not in places:
            raise NotHereError(f"there is no hull {one.hull!r}", where=one.asset)
    return [places[one.asset, one.hull] for one in request.hulls]


def _group(described: Mapping[str, _HullRows], places: Ints) -> tuple[HullsOfAsset, ...]:
    found, start = list[HullsOfAsset](), 0
    for asset, one in described.items():
        own: list[int] = (places[(places >= start) & (places < start + len(one.names))] - start).tolist()
        if own:
            found.append(HullsOfAsset(asset=asset, hulls=tuple(one.names[k] for k in own), positions=tuple(own)))
        start += len(one.names)
    return tuple(found)
