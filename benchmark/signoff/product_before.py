"""What people got through the product before anything was changed for them, kept in `unchanged.json` as it was then.

A reply had two implementations until then: one that the benchmark called, and the one that people use.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from benchmark.journal import ROOT
from benchmark.report import Result, Tell
from benchmark.signoff.client import Client
from benchmark.signoff.conditions import ERRS, NONE, list_tasks
from benchmark.signoff.queue import Review
from benchmark.signoff.session_tables import tell_amiss, tell_early, tell_ends
from benchmark.signoff.sessions import Unit, run_sessions
from benchmark.signoff.terminal import WrongClient
from benchmark.study import FLAT, REPORTED, TRUE
from benchmark.study.condition import PROPAGATED, SYSTEMATIC
from benchmark.tasks import DIFFICULTIES
from meshforge.common import write_atomically

FROZEN = Path(__file__).resolve().parent / "unchanged.json"
COMMAND = "python -m benchmark.signoff unchanged"
CONDITIONS = {
    Client.name: (TRUE, FLAT, SYSTEMATIC, PROPAGATED[2], NONE, ERRS),
    WrongClient.name: (FLAT, NONE),
}
"""Under which labels, by what a person does it with."""
TITLE = "Through the product, before anything was changed"


def list_units() -> list[Unit]:
    """One person a task and condition; those through `Project` first, and the tasks in an order in which the first
    third has each category, and each level about as often."""
    levels, every = len(DIFFICULTIES), list_tasks()
    turns = [every[k : k + levels] for k in range(0, len(every), levels)]
    names = [turn[(place + shift) % levels] for shift in range(levels) for place, turn in enumerate(turns)]
    rows = ((client, name, one) for client, some in CONDITIONS.items() for name in names for one in some)
    return [Unit(name, one.name, REPORTED[0], None, client) for client, name, one in rows]


def freeze(tell: Tell, path: Path = FROZEN) -> None:
    """Measure the product as it is, and write that with the commit that it is at."""
    units = list_units()
    found = run_sessions(units, tell, workers=1)
    commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    write(path, zip(units, found, strict=True), commit.strip())


def write(path: Path, sessions: Iterable[tuple[Unit, dict[str, Any]]], commit: str) -> None:
    """Write sessions, of each but the last point of its curve."""
    rows = []
    for unit, found in sessions:
        review = asdict(Review.of_json(found["review"]))
        rows.append({"client": unit.client, "computer": found["computer"], **review, "points": review["points"][-1:]})
    lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows)
    head = f'"command": {json.dumps(COMMAND)},\n"commit": {json.dumps(commit)}'
    write_atomically(path, f'{{\n{head},\n"sessions": [\n{lines}\n]\n}}\n')


@cache
def read(path: Path = FROZEN) -> tuple[str, tuple[tuple[str, Review], ...]]:
    """The commit that was measured, and what a person did it with, for each session."""
    data = json.loads(path.read_text("utf-8"))
    rows = [(row.pop("client"), row.pop("computer"), row) for row in data["sessions"]]
    return data["commit"], tuple((client, Review.of_json(row)) for client, _, row in rows)


def measure(tell: Tell, quick: bool) -> Result:
    """The figures that were kept; nothing is measured again."""
    commit, sessions = read()
    groups = dict[tuple[str, str], list[Review]]()
    for client, review in sessions:
        groups.setdefault((review.condition, client), []).append(review)
    through = {key: rows for key, rows in groups.items() if key[1] == Client.name}
    tables = (tell_ends(groups), tell_early(through), tell_amiss(sessions))
    return Result("product_before", TITLE, tables, (), tuple(_list_notes(commit, [one for _, one in sessions])))


def _list_notes(commit: str, reviews: Sequence[Review]) -> Iterator[str]:
    names = dict.fromkeys(one.task for one in reviews)
    yield (
        f"Frozen: measured once by `{COMMAND}` at commit {commit[:12]}, kept in `benchmark/signoff/unchanged.json`. "
        "`src` was as it was before anything of it was changed; this part is not measured again."
    )
    if len(names) < len(list_tasks()):
        yield (
            f"{len(names)} of the {len(list_tasks())} tasks, as time was short: {', '.join(names)}; of "
            "answers alone fewer, as the table says."
        )
    yield (
        "Each session is a project on disk that a person works with by the methods of `Project`. The family is that of "
        "the first reported person, 25 assets at one decomposition. What is right is judged on what the project would "
        "write: its program, then its edits by hand. By the commands `review --answers`, `demonstrate` and `label` "
        "alone the same person comes to the same, act by act (a test), so that this is not measured by itself."
    )
    yield (
        "*Answers alone*: a person, or a script, that demonstrates where the product asks for it, replies by `review "
        "--answers FILE --json`, and says of a wrong result no more than that it is wrong."
    )
    yield (
        "The person says that a result is wrong, which flags it, and then does what the command proposes: demonstrates "
        "that asset. Where no program fits that, they reply to what is asked, look through the labels there, and "
        "otherwise take the demonstration back. What is flagged or set aside is not right. After labels by hand come "
        "those that are propagated."
    )
    yield (
        "*Corrected one by one*: edits shown after a result was called wrong. *Before any look*: when there is the "
        "first program. Means over tasks; of the probabilities over assets on which a right edit is possible."
    )
