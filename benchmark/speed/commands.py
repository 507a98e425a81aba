"""Commands on ten and a few more small assets, as whole processes, beside a script that does the edit by hand."""

from __future__ import annotations

import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from benchmark.clock import once
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.speed import by_hand
from benchmark.speed.watch import compile_aside
from meshforge.cli.demo import create_tables
from meshforge.project import Project
from meshforge.samples import TABLES

_ROUNDS = 9
_FEW = 10  # assets that are labelled
_MOST_OF_SCRIPT = 0.7  # of the time of the script by hand that `apply` may take
_HAND = "the script by hand, trimesh"


@dataclass(frozen=True, slots=True)
class Contestant:
    """words: of the whole process, after Python; most: seconds that it may take; prepare: called before each run."""

    words: Sequence[str]
    most: float | None = None
    prepare: Callable[[], None] = lambda: None


def measure(tell: Tell, quick: bool) -> Result:
    """Time whole processes, in turns."""
    rounds = 1 if quick else _ROUNDS
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        contestants = _build_contestants(folder)
        found: dict[str, list[tuple[float, float]]] = {what: [] for what in contestants}
        environment = compile_aside(folder / "compiled")
        for turn in range(rounds + 1):
            tell(f"commands: round {turn} of {rounds}")
            for what, contestant in contestants.items():
                contestant.prepare()
                run = _time([sys.executable, *contestant.words], environment, folder)
                found[what] += [run] if turn else []
    return _result(contestants, found)


def _build_contestants(folder: Path) -> dict[str, Contestant]:
    tables = sorted(map(str, TABLES.glob("*.obj")))
    hand, out, fresh, empty = (folder / name for name in ("hand", "out", "fresh", "empty"))
    project = create_tables(folder / "family")
    project.synthesize()
    list(project.apply())
    family = str(project.folder)
    _create_unlabelled(empty)
    command = ("-m", "meshforge")
    forget = partial(shutil.rmtree, ignore_errors=True)

    def renew() -> None:
        forget(fresh)
        shutil.copytree(empty, fresh)

    return {
        _HAND: Contestant([str(Path(by_hand.__file__)), str(TABLES), str(hand)], None, lambda: forget(hand)),
        f"apply, {len(tables)} tables": Contestant(
            [*command, "apply", str(TABLES / "tables.mf"), *tables, "--out", str(out)], None, lambda: forget(out)
        ),
        f"check, {len(tables)} tables": Contestant([*command, "check", *tables], 1.0),
        f"status, {len(tables)} tables": Contestant([*command, "status", family], 0.5),
        f"synthesize, {len(tables)} tables": Contestant([*command, "synthesize", family, "--dry-run"], 1.0),
        f"label, {_FEW} tables, from files": Contestant(
            [*command, "label", str(fresh / "project"), "--with", "file"], 1.5, renew
        ),
        "info, a table": Contestant([*command, "info", tables[2]], 0.4),
        "render, a table": Contestant([*command, "render", tables[2], "--out", str(folder / "table.png")], 1.0),
        "mf.load, a table": Contestant(["-c", f"import meshforge as mf; mf.load({tables[2]!r})"], 0.3),
    }


def _create_unlabelled(folder: Path) -> None:
    """A project of a few tables with labels beside them, of which it knows nothing yet."""
    (folder / "assets").mkdir(parents=True)
    for source in sorted(TABLES.glob("table_*.obj"))[:_FEW]:
        for file in (source, source.with_suffix(".labels.json")):
            shutil.copyfile(file, folder / "assets" / file.name)
    words = ("panel", "leg", "handle", "drawer", "misc")
    Project.create(folder / "project", [folder / "assets" / "*.obj"], name="tables", vocabulary=words)


def _time(words: list[str], environment: dict[str, str], folder: Path) -> tuple[float, float]:
    """Seconds of a process: how long it took, and of all processors, that of its children counted."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = partial(subprocess.run, words, check=True, capture_output=True, env=environment, cwd=folder)
    seconds = once(run)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _result(contestants: dict[str, Contestant], found: dict[str, list[tuple[float, float]]]) -> Result:
    seconds = {what: statistics.median(run[0] for run in runs) for what, runs in found.items()}
    work = {what: statistics.median(run[1] for run in runs) for what, runs in found.items()}
    rows: list[tuple[Cell, ...]] = []
    for what in contestants:
        quickest = min(run[0] for run in found[what])
        rows.append(
            (what, seconds[what], quickest, seconds[what] / seconds[_HAND], work[what], work[what] / work[_HAND])
        )
    apply = next(what for what in contestants if what.startswith("apply"))
    goals = [Goal(f"{apply}, times the script by hand", "at most", _MOST_OF_SCRIPT, seconds[apply] / seconds[_HAND])]
    goals += [
        Goal(f"{what}, s", "at most", contestant.most, seconds[what])
        for what, contestant in contestants.items()
        if contestant.most
    ]
    columns = ("", "s", "quickest, s", "times the script", "s of processors", "times the script's")
    return Result(
        "commands",
        "Commands on a few small assets",
        (Table("Whole processes", columns, tuple(rows)),),
        tuple(goals),
        (
            f"`benchmark/speed/by_hand.py` does with trimesh what `{(TABLES / 'tables.mf').name}` does with the "
            f"{len(list(TABLES.glob('*.obj')))} bundled tables: it splits them, picks parts by label, replaces, merges "
            "and writes them. It checks nothing of what it writes, and reads nothing back.",
            "Start of Python and all imports are within the times; compiled files are there.",
            "Seconds of processors count workers that are forks of the command, not those of a server process.",
        ),
    )
