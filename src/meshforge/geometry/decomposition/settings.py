"""The settings of each decomposition engine: one field an option, with its help text and its limits."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, fields
from typing import Any, ClassVar

from meshforge.common import UsageError


def _option(default: Any, help: str, low: float | None = None, high: float | None = None, *choices: str) -> Any:
    return field(default=default, metadata={"help": help, "low": low, "high": high, "choices": choices})


class _Settings:
    """Checks every field against the limits in its metadata."""

    __slots__ = ()
    engine: ClassVar[str]
    package: ClassVar[str]

    def __post_init__(self) -> None:
        for option in fields(self):  # type: ignore[arg-type]  # subclasses are dataclasses
            _check(f"{self.engine} {option.name}", getattr(self, option.name), **option.metadata)

    def as_dict(self) -> dict[str, Any]:
        """The fields by name, for JSON."""
        return asdict(self)  # type: ignore[call-overload,no-any-return]  # as above


def _check(
    name: str, value: Any, *, help: str, low: float | None, high: float | None, choices: tuple[str, ...]
) -> None:
    if choices and value not in choices:
        raise UsageError(f"{value!r} is none of {', '.join(choices)}", where=name, remedy=help)
    if (low is not None and not value >= low) or (high is not None and not value <= high):
        bounds = f"between {low:g} and {high:g}" if low is not None and high is not None else f"at least {low:g}"
        raise UsageError(f"{value!r} is not {bounds}", where=name, remedy=help)


@dataclass(frozen=True, slots=True)
class CoacdSettings(_Settings):
    """Options of CoACD (Wei et al. 2022), with the defaults of its authors; limits are those of its own program."""

    engine: ClassVar[str] = "coacd"
    package: ClassVar[str] = "coacd"
    threshold: float = _option(0.05, "Concavity at which splitting stops: lower gives more, closer hulls.", 0.01, 1)
    max_convex_hull: int = _option(-1, "Most hulls to make, by merging; -1 sets no limit.", -1)
    preprocess_mode: str = _option(
        "auto", "Remesh by voxels first: always, never, or when not watertight.", None, None, "auto", "on", "off"
    )
    preprocess_resolution: int = _option(50, "Voxels along the longest side when remeshing.", 20, 200)
    resolution: int = _option(2000, "Points sampled to measure concavity.", 100, 10000)
    mcts_nodes: int = _option(20, "Cutting planes tried in each direction.", 5, 40)
    mcts_iterations: int = _option(150, "Steps of the search for each cut.", 10, 2000)
    mcts_max_depth: int = _option(3, "Cuts that the search looks ahead.", 2, 7)
    pca: bool = _option(False, "Cut along the principal axes instead of the coordinate axes.")
    merge: bool = _option(True, "Merge hulls again where that costs no accuracy.")
    decimate: bool = _option(False, "Reduce each hull to max_ch_vertex vertices.")
    max_ch_vertex: int = _option(256, "Most vertices of a hull when decimating.", 4, 4096)
    extrude: bool = _option(False, "Extend neighbouring hulls into each other along their cuts.")
    extrude_margin: float = _option(0.01, "How far to extend hulls.", 0, 1)
    apx_mode: str = _option("ch", "Approximate by convex hulls or by boxes.", None, None, "ch", "box")
    real_metric: bool = _option(False, "Read threshold in metres instead of relative to the size.")
    seed: int = _option(0, "Seed of the search; the same seed gives the same hulls.", 0, 2**31 - 1)


@dataclass(frozen=True, slots=True)
class VhacdSettings(_Settings):
    """Options of V-HACD 4 (Mamou, Ratcliff), with the defaults of its authors. It has no seed: it is deterministic."""

    engine: ClassVar[str] = "vhacd"
    package: ClassVar[str] = "vhacdx"
    max_convex_hulls: int = _option(64, "Most hulls to make.", 1, 4096)
    resolution: int = _option(400_000, "Voxels in all: more is closer and slower.", 1000, 64_000_000)
    volume_error: float = _option(1.0, "Stop splitting where voxels and hull differ by this percentage.", 0.001, 10)
    max_recursion_depth: int = _option(10, "Most cuts on top of each other.", 1, 64)
    shrink_wrap: bool = _option(True, "Pull the hulls' vertices from the voxels onto the mesh.")
    fill_mode: str = _option(
        "flood", "How the inside is found: flood and raycast need a closed mesh, surface keeps a shell.",
        None, None, "flood", "surface", "raycast",
    )  # fmt: skip
    max_hull_vertices: int = _option(64, "Most vertices of a hull.", 4, 2048)
    min_edge_length: int = _option(2, "Parts of fewer voxels than this along every side are not split.", 1, 64)
    find_best_plane: bool = _option(False, "Search the best cut instead of the middle (slow).")


DecomposeSettings = CoacdSettings | VhacdSettings
