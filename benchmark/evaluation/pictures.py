"""The pictures of the benchmark's page: tasks, what fails, mutants, sessions and real families, before and after."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from benchmark.assets import MERGED
from benchmark.assets.pictures import upright
from benchmark.evaluation import failures, mutation, real
from benchmark.evaluation.gallery import overview
from benchmark.evaluation.sessions import QUICK
from benchmark.report import Result
from benchmark.speed.assets import corpus
from benchmark.study import Session
from benchmark.tasks import task, tasks
from meshforge.rendering import draw_before_after, make_contact_sheet, write_png

if TYPE_CHECKING:
    from PIL.Image import Image

_SESSIONS = "Sessions that ended with another behaviour: before, as learned, as meant (true labels)"


def list_pictures(part: str, result: Result) -> Iterator[tuple[str, str]]:
    """The pictures that a part has: file and caption."""
    if part == "effectiveness" and any(not Session.of_json(row).right for row in result.details):
        yield "sessions.png", _SESSIONS
    if part == "mutation" and any(row["reason"] for row in result.details):
        yield "mutants.png", "Mutants that do the same job"
    if part == "ceiling" and _choose_failures(result):
        yield "failures.png", "What fails under the reference program: before, after"
    if part == "real":
        for table in result.tables[:1]:
            for row in table.rows:
                yield f"real-{row[0]}.png", f"Real {row[0]} before and after the reference's edit of the hard task"


def draw(folder: Path, results: Mapping[str, Result], quick: bool, part: str | None) -> None:
    """Draw the pictures of a part, None: of all; and those of tasks, which are there from the first part on."""
    folder.mkdir(parents=True, exist_ok=True)
    drawings: dict[str, Callable[[Path, Result], object]] = {
        "ceiling": _draw_failures,
        "mutation": _draw_mutants,
        "effectiveness": _draw_sessions,
        "real": _draw_families,
    }
    if part is None or not (folder / "tasks.png").is_file() or part == "ceiling":
        _draw_tasks(folder, quick)
    for name, drawing in drawings.items():
        if name in results and part in (None, name):
            drawing(folder, results[name])


def _draw_tasks(folder: Path, quick: bool) -> None:
    every = [one for one in tasks() if not quick or one.category == QUICK]
    shown = [
        draw_before_after(upright(sample), after, size=(200, 160), vocabulary=task(name).program.labels)
        for name, sample, after in overview(every)
    ]
    write_png(folder / "tasks.png", make_contact_sheet(shown, 3, [one.name for one in every]))


def _draw_failures(folder: Path, result: Result) -> None:
    if meshes := _choose_failures(result):
        images = [_draw_failure(*row) for row in meshes]
        write_png(folder / "failures.png", make_contact_sheet(images, 2, [f"{a}, {b}" for a, b in meshes]))


def _draw_mutants(folder: Path, result: Result) -> None:
    _draw_pairs(folder / "mutants.png", list(mutation.pictures(result.details)))


def _draw_sessions(folder: Path, result: Result) -> None:
    _draw_pairs(folder / "sessions.png", list(failures.pictures([Session.of_json(row) for row in result.details])))


def _draw_pairs(path: Path, rows: Sequence[tuple[str, Image]]) -> None:
    if rows:
        captions, images = zip(*rows, strict=True)
        write_png(path, make_contact_sheet(images, 2, captions))


def _draw_families(folder: Path, result: Result) -> None:
    """Where the corpus is not here, the pictures that there are stay."""
    if corpus() is not None:
        real.draw_pictures([str(row[0]) for row in result.tables[0].rows], folder)


def _choose_failures(result: Result) -> Sequence[tuple[str, str]]:
    """Task and mesh of what fails: pure ones, and of each task's impure ones the first."""
    rows = [row for row in result.details if row["reference"] is not None and row.get("set") not in MERGED]
    pure = [(row["task"], row["mesh"]) for row in rows if not row["impure"]]
    first = {row["task"]: row["mesh"] for row in reversed(rows) if row["impure"]}
    return [*pure, *first.items()][:12]


def _draw_failure(name: str, mesh: str) -> Image:
    one = task(name)
    sample = next(row for row in one.samples() if row.name == mesh)
    edited = one.run(one.program, sample.mesh)
    after = upright(sample, edited.mesh) if edited.mesh else upright(sample)
    return draw_before_after(upright(sample), after, size=(260, 200), vocabulary=one.program.labels)
