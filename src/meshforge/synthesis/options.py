"""How a search is limited, and which of its shortcuts it takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Layers = Literal["S", "S+T", "S+G", "S+T+G"]
LAYERS: tuple[Layers, ...] = get_args(Layers)
Strategy = Literal["default", "paper"]
STRATEGIES: tuple[Strategy, ...] = get_args(Strategy)


@dataclass(frozen=True, slots=True)
class Shortcuts:
    """Ways of doing less for the same answer; each can be switched off, to see that the answer stays the same.

    merge: of the extractors that select the same, only the first in the order is built upon.
    group: hulls that no extractor can tell apart count as one.
    complete: the missing operand of a set operator is looked up by what it must hold and avoid.
    help: an operand that brings its goal no nearer is passed over.
    stored: up to this size every selection is kept in an index, beyond only goals are followed.
    few: the search begins with this many of the demonstrated groups of hulls; those that refute its answer join
    (0: all at once).
    """

    merge: bool = True
    group: bool = True
    complete: bool = True
    help: bool = True
    stored: int = 5
    few: int = 48


@dataclass(frozen=True, slots=True)
class Options:
    """How to learn, and its limits.

    strategy: `paper` follows the algorithms of the paper to the letter, as a yardstick.
    layers: which extractors it may use besides set operators: semantic, topological, geometric (paper, ablation).
    repair: whether wrong labels are looked for; eta: corrections a mesh, over all rules, at most.
    max_size: in syntax nodes; budget: for the whole program [s].
    above: readings have up to so many nodes more than the smallest; effort: how many operands they may take to find.
    """

    strategy: Strategy = "default"
    layers: Layers = "S+T+G"
    repair: bool = True
    eta: int = 2
    max_size: int = 13
    budget: float = 120.0
    above: int = 4
    effort: int = 100_000
    shortcuts: Shortcuts = Shortcuts()
