"""The curves of right assets against seconds of a person, as SVG, the same bytes from the same figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmark.evaluation.plots import begin_figure, save_figure
from benchmark.report import Result
from benchmark.signoff.tables import BEFORE, BY_HAND, CURVES, QUEUE, REFERENCE

_LOOKS: dict[str, dict[str, Any]] = {
    QUEUE: {"color": "#264653", "lw": 2},
    BEFORE: {"color": "#e9a23b"},
    BY_HAND: {"color": "#c8553d", "ls": "--"},
    REFERENCE: {"color": "#8d99ae", "ls": ":"},
}
_ACROSS = 3
_FILE = "signoff-curves.svg"


def draw_curves(folder: Path, found: Sequence[Mapping[str, Any]]) -> str:
    """Draw them beside the results of the page, by condition; Markdown that shows them, empty where there are none."""
    for result in map(Result.of_json, found):
        table = next((table for table in result.tables if table.title == CURVES), None)
        if table is not None and table.rows:
            _draw([float(column) for column in table.columns[2:]], table.rows, folder / _FILE)
            return f"![Edits right against seconds of a person]({_FILE})\n"
    return ""


def _draw(seconds: Sequence[float], rows: Sequence[Sequence[Any]], path: Path) -> None:
    conditions = list(dict.fromkeys(row[0] for row in rows))
    figure, axes = begin_figure(_ACROSS, 2.6, -(-len(conditions) // _ACROSS))
    places = list(axes.flat)
    for axis, condition in zip(places, conditions, strict=False):
        for _, who, *shares in (row for row in rows if row[0] == condition):
            axis.plot(seconds, shares, label=who, **_LOOKS[who])
        axis.set(title=condition, ylim=(-3, 103), xlim=(0, max(seconds)))
        axis.title.set_fontsize(8)
    for axis in places[len(conditions) :]:
        axis.axis("off")
    for place in range(0, len(conditions), _ACROSS):
        places[place].set_ylabel("right, %")
    for place in range(max(len(conditions) - _ACROSS, 0), len(conditions)):
        places[place].set_xlabel("s of a person, modelled")
    places[0].legend(frameon=False, fontsize=6, loc="lower right")
    save_figure(figure, path)
