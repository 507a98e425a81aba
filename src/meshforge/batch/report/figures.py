"""The figures of a whole run, of which a page may show only some assets."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from meshforge.batch.report.asset import ReportAsset, Status
from meshforge.batch.report.words import change
from meshforge.batch.summary import Summary


@dataclass(frozen=True, slots=True)
class Figures:
    """counts: of assets by what became of them; more: figures by name, each with a remark that is small.

    first: which of very many assets are shown first, in words.
    """

    counts: Mapping[Status, int]
    more: Mapping[str, tuple[str, str | None]]
    first: str = "those that failed"

    @property
    def total(self) -> int:
        """How many assets there were."""
        return sum(self.counts.values())

    @staticmethod
    def of_run(summary: Summary, words: Mapping[Status, Status] | None = None) -> Figures:
        """Those of a program's run, or of a conversion; words: other ones for what became of assets."""
        counts: dict[Status, int] = {(words or {}).get(word, word): n for word, n in summary.counts.items()}
        return Figures(counts, _hulls(summary.before, summary.after))

    @staticmethod
    def of_assets(assets: Iterable[ReportAsset]) -> Figures:
        """Those of a run of which all assets are shown."""
        shown = list(assets)
        known = [asset.counts for asset in shown if asset.counts]
        before, after = (sum(counts[k] for counts in known) for k in (0, 1))
        return Figures(Counter(asset.status for asset in shown), _hulls(before, after))


def _hulls(before: int, after: int) -> dict[str, tuple[str, str | None]]:
    return {"hulls": (f"{before:,} → {after:,}", change(before, after))} if before or after else {}
