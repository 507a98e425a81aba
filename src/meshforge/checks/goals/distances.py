"""Goals on distances: between parts, and from what the asset shows."""

from dataclasses import dataclass, field

from meshforge.checks.fit import measure_fit
from meshforge.checks.goals.base import Goal, GoalSubject, NotApplicableError
from meshforge.checks.physics.scene import Failure, describe_hull, mm
from meshforge.geometry import close_pairs
from meshforge.language import Extractor, ExtractorArgument, OptionArgument, QuantityArgument, Share
from meshforge.symbolic import Hull

_KEPT = 0.9
"""Of a gap before the edit, that is to be left by default."""


@dataclass(frozen=True, slots=True)
class Clear(Goal):
    """All that did not touch a selection before keeps its distance, or only what a second extractor selects."""

    part: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What keeps its distance"})
    other: Extractor | None = field(
        default=None,
        metadata={"argument": ExtractorArgument(), "title": "From", "omitted": "all that it did not touch"},
    )
    gap: float | Share = field(
        default=Share(_KEPT),
        metadata={"argument": OptionArgument("gap", QuantityArgument("m", of="the gap before")), "title": "Gap"},
    )

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        before, after = self._group(subject, after=False), self._group(subject, after=True)
        part = subject.select_after(self.part)
        if not part:
            return Failure(f"nothing of {self.part} is left")
        for label, hulls in before.items():
            apart = measure_gap(subject.select(self.part), hulls, subject.start.diagonal)[0]
            if label not in after or (self.other is None and apart <= subject.touching):
                continue
            wanted = self.gap.value * apart if isinstance(self.gap, Share) else self.gap
            gap, pair = measure_gap(part, after[label], subject.start.diagonal)
            if pair and gap < wanted:
                one, other = pair
                text = f"{describe_hull(one)} is {mm(max(gap, 0.0))} from {describe_hull(other)}, {mm(wanted)} wanted"
                return Failure(f"{text}; {mm(max(apart, 0.0))} before", (one.name, other.name))
        return None

    def _group(self, subject: GoalSubject, *, after: bool) -> dict[str | None, list[Hull]]:
        """The hulls from which the part keeps its distance, by label, since names change; else in one group."""
        if self.other is not None:
            return {None: list(subject.select_after(self.other) if after else subject.select(self.other))}
        part = {hull.name for hull in (subject.select_after(self.part) if after else subject.select(self.part))}
        groups = dict[str | None, list[Hull]]()
        for hull in subject.hulls if after else subject.hulls_before:
            if hull.name not in part:
                groups.setdefault(hull.label, []).append(hull)
        return groups


def measure_gap(one: tuple[Hull, ...], other: list[Hull], reach: float) -> tuple[float, tuple[Hull, Hull] | None]:
    """Return the smallest distance [m] between hulls of two groups, negative where they overlap, and the pair."""
    hulls = [*one, *other]
    pairs = close_pairs([hull.shape for hull in hulls], reach, frozenset(range(len(one))))
    across = {pair: gap for pair, gap in pairs.items() if pair[0] < len(one) <= pair[1]}
    if not across:
        return reach, None
    i, j = min(across, key=across.__getitem__)
    return across[i, j], (hulls[i], hulls[j])


@dataclass(frozen=True, slots=True)
class Fits(Goal):
    """No hull of a selection sticks out of what the asset shows there, or leaves it bare, by more than a tolerance."""

    part: Extractor = field(metadata={"argument": ExtractorArgument(), "title": "What fits"})
    tolerance: float | Share = field(
        default=Share(0.02),
        metadata={
            "argument": OptionArgument("tolerance", QuantityArgument("m", of="the diagonal")),
            "title": "Tolerance",
        },
    )

    def find_failure(self, subject: GoalSubject) -> Failure | None:
        if not subject.surfaces:
            raise NotApplicableError("it shows nothing that hulls could fit")
        names = {hull.name for hull in subject.select_after(self.part)}
        if not names:
            return Failure(f"nothing of {self.part} is left")
        limit = self.tolerance.value * subject.start.diagonal if isinstance(self.tolerance, Share) else self.tolerance
        rows = [row for row in measure_fit(subject.shown).hulls if row.hull in names]
        if not rows:
            raise NotApplicableError(f"the bodies of {self.part} show nothing")
        worst = max(rows, key=lambda row: max(row.out, row.bare))
        if max(worst.out, worst.bare) <= limit:
            return None
        how = "sticks out" if worst.out >= worst.bare else "leaves what is shown bare"
        text = f"{worst.hull} {how} by {mm(max(worst.out, worst.bare))}, {mm(limit)} allowed"
        return Failure(text, (worst.hull,))
