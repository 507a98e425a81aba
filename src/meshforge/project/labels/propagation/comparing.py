"""The hulls of a whole family compared with those whose labels are told."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from meshforge.batch import Lost, Spread, isolated
from meshforge.batch.workers.pool import heed
from meshforge.errors import MeshForgeError
from meshforge.geometry import Floats
from meshforge.project.labels.propagation.sketches import Sketches
from meshforge.project.labels.propagation.stages import Stage
from meshforge.symbolic import Label

if TYPE_CHECKING:
    from meshforge.perception.propagation import Family, Propagated


@dataclass(frozen=True, eq=False)
class Compared:
    """What labels say about all hulls. assets: those that were described, in order; lost: why others were not."""

    assets: tuple[str, ...]
    found: Propagated
    lost: dict[str, str]

    @property
    def has_labels(self) -> bool:
        """Whether there is any label to go by."""
        return bool(self.found.family.labels)

    @cached_property
    def next(self) -> str | None:
        """The asset that would help most if it were labelled; None: all are."""
        return next((self.assets[place] for place in self.found.next_to_label()), None)

    def labels(self, asset: str) -> list[Label | None]:
        """The labels of the hulls of an asset."""
        return self.found.labels(self._places[asset])

    @cached_property
    def _places(self) -> dict[str, int]:
        return {asset: place for place, asset in enumerate(self.assets)}


def compared(sketches: Sketches, told: Mapping[str, Sequence[str | None]], spread: Spread, stage: Stage) -> Compared:
    """Compare all hulls. told: of each asset the labels of its hulls, as far as known; spread, stage: of the work."""
    from meshforge.perception.propagation import family_of, righted, weights

    seen = {asset: sketches.read_rows(asset) for asset in told}
    missing = [asset for asset, own in seen.items() if own is None]
    with stage(len(missing), "describing") as advance:
        lost = dict(sketches.describe(missing, advance))
    seen |= {asset: sketches.read_rows(asset) for asset in missing}
    described = {asset: own for asset, own in seen.items() if own}
    lost |= {asset: f"{asset}: how it is described was not kept" for asset in missing if asset not in described | lost}
    assets = tuple(described)
    family = family_of([*described.values()]).with_labels([label for asset in assets for label in told[asset]])
    del seen, described
    doubtful = list(_doubtful(family, assets, sketches, spread.stop))
    with stage(len(doubtful), "looking at other sides") as advance:
        places = {asset: place for place, asset in enumerate(assets)}
        looked = _looked(sketches.describe_sides(doubtful, advance), places, lost)
        family = righted(family, looked, weights())
    return Compared(assets, _in_the_end(family, spread.stop), lost)


def _doubtful(
    family: Family, assets: Sequence[str], sketches: Sketches, stop: Callable[[], bool] | None
) -> Iterator[tuple[str, tuple[int, ...]]]:
    """The assets that may lie on another side, and on which."""
    from meshforge.perception.propagation import doubtful_sides, weights

    for place, sides in doubtful_sides(family, lambda place: sketches.read_sides(assets[place]), weights()):
        heed(stop)
        if sides:
            yield assets[place], sides


def _looked(
    found: Iterable[tuple[str, list[Floats] | str]], places: Mapping[str, int], lost: dict[str, str]
) -> Iterator[tuple[int, list[Floats]]]:
    """What was found of each asset, by its place; why that of some was not found goes to `lost`."""
    for asset, rows in found:
        if isinstance(rows, str):
            lost[asset] = rows
        else:
            yield places[asset], rows


def _in_the_end(family: Family, stop: Callable[[], bool] | None) -> Propagated:
    """What labels say, in a process of its own where that may have to be stopped in the midst."""
    from meshforge.perception.propagation import compared_hulls

    (found,) = isolated(compared_hulls, [family], workers=1 if stop else 0, stop=stop)
    if isinstance(found, Lost):
        raise MeshForgeError(f"the labels could not be carried over: {found.why}")
    return found
