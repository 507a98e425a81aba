"""Makes the assets of a category: which kinds and how many, how each lies in its file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Protocol, cast

import numpy as np

from benchmark.assets.asset import Asset, Design
from benchmark.assets.draw import Draw
from meshforge.geometry import Pose

CATEGORIES = ("cup", "kettle", "knife", "chair", "dispenser", "door", "lamp", "table")
COUNT = 25
"""Assets of a category."""
SEED, CALIBRATION = 2026, 1913
"""Seeds of the benchmark, and of the meshes that anything may be tuned on."""


class Category(Protocol):
    """What a category's module offers.

    LABELS: of its parts; KINDS: how many of 25 are of which variant; RARE: which of them are rare, at most 3 of 25.
    """

    LABELS: tuple[str, ...]
    KINDS: Mapping[str, int]
    RARE: frozenset[str]

    def build(self, kind: str, draw: Draw) -> Design:
        """One asset."""


def category(name: str) -> Category:
    """The module of a category."""
    return cast(Category, import_module(f"benchmark.assets.categories.{name}"))


@dataclass(frozen=True, slots=True)
class Order:
    """An asset that is to be made: the how manyth of a category, of which kind, by which seed."""

    category: str
    number: int
    kind: str
    seed: int

    @property
    def name(self) -> str:
        """What the asset is called."""
        return f"{self.category}_{self.number:02}"

    def draw(self, attempt: int = 0) -> Asset:
        """The asset; attempt: from 1 on, another one of the same kind."""
        module, draw = category(self.category), _draw(self.seed, self.category, self.number, attempt)
        made = module.build(self.kind, draw)
        for part in made.parts:
            assert part.label in module.LABELS, f"{self.name}: {part.label}"
        pose, scanned = _draw_pose(draw)
        rare = self.kind in module.RARE
        return Asset(
            self.name, self.category, self.kind, rare, made.about, made.parts, made.sites, pose, scanned, attempt
        )


def orders(name: str, count: int = COUNT, seed: int = SEED) -> list[Order]:
    """The assets of a category, every kind in its share, in an order that tells nothing."""
    return [Order(name, number, kind, seed) for number, kind in enumerate(kinds(name, count, seed), 1)]


def kinds(name: str, count: int, seed: int) -> list[str]:
    """The kinds of so many assets: of each its share, rounded so that the sum is right, of a rare one at least one."""
    module = category(name)
    total = sum(module.KINDS.values())
    assert total == COUNT, f"{name}: the kinds add up to {total}"
    assert all(module.KINDS[kind] <= 3 for kind in module.RARE)
    exact = {kind: share * count / COUNT for kind, share in module.KINDS.items()}
    counts = {kind: max(int(x), int(kind in module.RARE)) for kind, x in exact.items()}
    while sum(counts.values()) < count:
        counts[max(exact, key=lambda kind: exact[kind] - counts[kind])] += 1
    every = [kind for kind, number in counts.items() for _ in range(number)]
    order = _draw(seed, name, 0).rng.permutation(len(every))
    return [every[k] for k in order][:count]


def _draw_pose(draw: Draw) -> tuple[Pose, bool]:
    """Any yaw, a tilt for a third, somewhere near the origin; one in five is decomposed as it lies."""
    yaw, tilted = draw.length(-np.pi, np.pi), draw.chance(1 / 3)
    roll, pitch = (draw.length(-0.5, 0.5), draw.length(-0.5, 0.5)) if tilted else (0.0, 0.0)
    shift = [round(draw.length(-0.5, 0.5), 3) for _ in range(3)]
    return Pose.from_rpy(shift, (roll, pitch, 0.0)) @ Pose.from_rpy((0, 0, 0), (0.0, 0.0, yaw)), draw.chance(0.2)


def _draw(seed: int, name: str, number: int, attempt: int = 0) -> Draw:
    return Draw(seed, *name.encode(), number, attempt=attempt)
