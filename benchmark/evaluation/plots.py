"""Plots of the results, as SVG, the same bytes from the same figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benchmark.report import Result, Table

_COLORS = {"easy": "#2a9d8f", "medium": "#e9a23b", "hard": "#c8553d", "all": "#264653", "paper": "#8d99ae"}
_PARTS = ("#264653", "#2a9d8f", "#e9a23b", "#c8553d", "#8d6a9f", "#8d99ae", "#5b8e3e", "#d98cb3")


def plots(results: Mapping[str, Result], folder: Path) -> dict[str, str]:
    """Draw what there are figures for; the names of the files by the part that they belong to."""
    folder.mkdir(parents=True, exist_ok=True)
    drawn = {}
    for part, draw in {"effectiveness": _few_shot_and_phases, "ablation": _layers, "scaling": _growth}.items():
        if part in results:
            draw(results[part], folder / f"{part}.svg")
            drawn[part] = f"{part}.svg"
    return drawn


def _table(result: Result, beginning: str) -> Table:
    return next(table for table in result.tables if table.title.startswith(beginning))


def begin_figure(columns: int, height: float = 2.9, rows: int = 1) -> tuple[Any, Any]:
    """A figure and its axes, side by side and one row below the other."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "meshforge", "font.size": 9, "axes.spines.top": False,
                                "axes.spines.right": False, "svg.fonttype": "path"})  # fmt: skip
    import matplotlib.pyplot as plt

    return plt.subplots(rows, columns, figsize=(3.4 * columns, height * rows), layout="constrained")


def save_figure(figure: Any, path: Path) -> None:
    """Write it, without a date."""
    import matplotlib.pyplot as plt

    figure.savefig(path, metadata={"Date": None}, facecolor="white")
    plt.close(figure)


def _few_shot_and_phases(result: Result, path: Path) -> None:
    """SSR against k with questions and without, the paper's beside them; time by phase."""
    figure, axes = begin_figure(3)
    table = _table(result, "SSR at k")
    ks = [int(column.split("=")[1]) for column in table.columns[2:]]
    for place, condition in enumerate(("true labels", "noisy labels, flat confidence")):
        axis = axes[place]
        for row in table.rows:
            if row[0] == condition:
                axis.plot(ks, row[2:], marker="o", ms=3, color=_COLORS[str(row[1])], label=str(row[1]))
        paper = {k: float(str(x)) for k, x in zip(ks, table.rows[0][2:], strict=True) if str(x) not in ("", "–")}
        axis.plot(list(paper), list(paper.values()), "s", mfc="none", color=_COLORS["paper"], label="paper, all")
        axis.set(title=condition, xlabel="demonstrations plus answers", ylabel="SSR, %", ylim=(-3, 103))
    axes[0].legend(frameon=False, fontsize=7)  # once: the same in both
    _phases(_table(result, "Time by phase"), axes[2])
    save_figure(figure, path)


def _phases(table: Table, axis: Any) -> None:
    lows = [0.0] * len(table.rows)
    for place, phase in enumerate(table.columns[1:], 1):
        seconds = [float(str(row[place]).split(" ")[0]) for row in table.rows]
        axis.barh([str(row[0]) for row in table.rows], seconds, left=lows, color=_PARTS[place - 1], label=phase)
        lows = [a + b for a, b in zip(lows, seconds, strict=True)]
    axis.set(title="time a task", xlabel="s (the person's: modelled)")
    axis.legend(frameon=False, fontsize=6, loc="upper center", bbox_to_anchor=(0.4, -0.22), ncols=3)


def _layers(result: Result, path: Path) -> None:
    figure, axis = begin_figure(1)
    table = result.tables[0]
    names = [str(row[0]) for row in table.rows]
    ours = [float(str(row[2]).split("=")[1]) for row in table.rows]
    for shift, values, color, label in (
        (-0.2, [float(row[1]) for row in table.rows], _COLORS["paper"], "paper"),
        (0.2, ours, _COLORS["all"], "here"),
    ):
        axis.bar([k + shift for k in range(len(names))], values, 0.4, color=color, label=label)
    axis.set(xticks=range(len(names)), xticklabels=names, ylabel="SSR", ylim=(0, 1.05))
    axis.legend(frameon=False, fontsize=7, loc="upper left")
    save_figure(figure, path)


def _growth(result: Result, path: Path) -> None:
    figure, axes = begin_figure(len(result.tables))
    for axis, table in zip(axes, result.tables, strict=True):
        values = [float(row[0]) for row in table.rows]
        for place in range(2, 6):
            label = table.columns[place].removesuffix(", s")
            seconds = [max(float(row[place]), 1e-4) for row in table.rows]
            axis.loglog(values, seconds, marker="o", ms=3, color=_PARTS[place - 2], label=label)
        axis.set(xlabel=table.title.lower(), ylabel="s")
        if max(values) < 100:
            axis.set_xticks(values, [f"{value:.0f}" for value in values], minor=False)
            axis.set_xticks([], minor=True)
    axes[0].legend(frameon=False, fontsize=7)  # once: the same in all
    save_figure(figure, path)
