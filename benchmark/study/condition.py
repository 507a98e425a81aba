"""The conditions under which tasks are taught: which labels, which decomposition, which person."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from benchmark.assets import MERGED, SEPARATE
from meshforge.synthesis import Layers, Options

TUNING, REPORTED = range(5), range(100, 105)
"""Seeds of the demonstrators: what anything may be tuned on, and what is reported."""

MOST = 5
"""Demonstrations that a person gives at most (paper, protocol)."""
SEEN = 12
"""Meshes of which a person looks at the result before accepting it."""
Labels = Literal["true", "telling", "flat", "systematic", "propagated"]
"""True ones; noisy ones whose confidence tells which are wrong, or does not; a kind of part called by a wrong name in a
third of the assets; those that are propagated from meshes that a person labelled."""
FirstMesh = Literal["random", "rich", "advised"]
"""Which mesh a person demonstrates first: any; of a dozen one that has work for most rules; of these the one that the
tool proposes."""


@dataclass(frozen=True, slots=True)
class Condition:
    """How a task is taught.

    labelled: meshes that a person labels before the first demonstration, as advised, if labels are propagated;
    decomposition: `separate` (each demonstrator gets the coarse, the medium or the fine family), `union` or `welded`;
    questions: whether the tool's questions are answered; layers, repair: ablations of the tool; errs: the share of
    answers and confirmations that are wrong; first: the mesh that is demonstrated first; guided: the results that are
    looked at are those that the tool proposes, and what is right there is reported to it, else they are drawn at
    random; names_rules: where a result is wrong, only the rule that failed is shown there, else the whole edit again;
    excuses: a result that the reference gets wrong too, since a label is wrong, is passed over; few: three of the five
    demonstrators, one for each decomposition.
    """

    name: str
    labels: Labels = "true"
    labelled: int = 0
    decomposition: str = "separate"
    questions: bool = True
    layers: Layers = "S+T+G"
    repair: bool = True
    errs: float = 0.0
    first: FirstMesh = "random"
    guided: bool = False
    names_rules: bool = False
    excuses: bool = False
    few: bool = False

    @property
    def options(self) -> Options:
        """The tool's; it suggests no orientation, as every demonstrator gives one."""
        return Options(layers=self.layers, repair=self.repair, suggest_orientation=False)

    def seeds(self, demonstrators: Sequence[int]) -> list[int]:
        """Those of the demonstrators who teach under it."""
        return list(demonstrators)[: len(SEPARATE) if self.few else None]

    def setting(self, seed: int) -> str:
        """The decomposition of the family that a demonstrator gets."""
        return SEPARATE[seed % len(SEPARATE)] if self.decomposition == "separate" else self.decomposition

    def vary(self, how: str, **changes: Any) -> Condition:
        """The same but for something, by fewer demonstrators."""
        return replace(self, name=f"{self.name}: {how}", few=True, **changes)

    def vary_to_kind_person(self) -> Condition:
        """The same with the person of the first edition, who helps the tool in every way."""
        return self.vary("kind person", first="advised", guided=True, names_rules=True, excuses=True)


TRUE = Condition("true labels")
FLAT = Condition("noisy labels, flat confidence", "flat")
TELLING = Condition("noisy labels, telling confidence", "telling", few=True)
SYSTEMATIC = Condition("systematic errors", "systematic", few=True)
PROPAGATED = tuple(
    Condition(f"propagated from {count or 'none'}", "propagated", count, few=count != 2) for count in range(4)
)
KIND = replace(TRUE.vary_to_kind_person(), few=False)
UNREPAIRED = FLAT.vary("no repair", repair=False)
MERGED_SETS = tuple(replace(TRUE, name=f"true labels, {sort}", decomposition=sort, few=True) for sort in MERGED)
ABLATIONS = tuple(Condition(layers, layers=layers) for layers in get_args(Layers) if layers != "S+T+G")

MAIN = (TRUE, TELLING, FLAT, SYSTEMATIC, *reversed(PROPAGATED))
"""Each kind of labels, with a person who helps the tool in no way: the rows that stand first."""
HELP = (
    TRUE.vary("the tool's dozen", guided=True),
    TRUE.vary("rich first mesh", first="rich"),
    TRUE.vary("advised first mesh", first="advised"),
    TRUE.vary("names the failing rule", names_rules=True),
    KIND,
    TRUE.vary("no questions", questions=False),
    TELLING.vary_to_kind_person(),
    FLAT.vary("the tool's dozen", guided=True),
    FLAT.vary("excuses what labels cause", excuses=True),
    FLAT.vary_to_kind_person(),
    UNREPAIRED,
    FLAT.vary("errs in 5%", errs=0.05),
    SYSTEMATIC.vary_to_kind_person(),
    PROPAGATED[2].vary_to_kind_person(),
)
"""What each kindness of a person changes, one by one and all together; and what the tool's own means do."""
CONDITIONS = {condition.name: condition for condition in (*MAIN, *HELP, *MERGED_SETS, *ABLATIONS)}
"""All conditions by name."""
