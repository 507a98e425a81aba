"""What became of labels that were given to the whole family at once."""

from __future__ import annotations

from typing import Literal

from meshforge.studio.wire.base import Wire
from meshforge.studio.wire.jobs import Mode

Way = Literal["propagate", "label-files", "label-names", "label-vlm"]


class RelabelledAsset(Wire):
    """Hulls of an asset that got another label, by their positions. new: those that had none; changed: those that had
    another one; was: the label that each of these had."""

    asset: str
    new: tuple[int, ...] = ()
    changed: tuple[int, ...] = ()
    was: tuple[str, ...] = ()


class Relabelled(Wire):
    """What the last edit did, where that was one of all labels. entry: its number in the history; way: what it was.

    settled: how many labels are sure since, which were not before.
    """

    entry: int
    way: Way
    assets: tuple[RelabelledAsset, ...]
    settled: int = 0


class CarriedOver(Wire):
    """Labels were carried over. unused: how many labels people and files gave since; next: the asset that would help
    most if it were labelled, null where its hulls are, or where all are."""

    unused: int
    next: str | None = None


class Model(Wire):
    """The model that can be asked for labels. host: where it is; mode, max_cost: as meshforge.toml has them; why: what
    is in the way of asking it, null where nothing is."""

    name: str
    host: str
    mode: Mode
    max_cost: float | None = None
    why: str | None = None
