"""Sessions that ended with another behaviour than the reference's: the reason for each, and pictures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from benchmark.assets.pictures import upright
from benchmark.report import Table
from benchmark.study import CONDITIONS, Session, open_bench
from benchmark.tasks import EditResult, task
from meshforge.language import Program, Rule, show, size_of
from meshforge.rendering import make_contact_sheet, render
from meshforge.rendering.comparison import joint_bounds
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

_SIZE = (170, 150)

COLUMNS = ("task", "condition", "seed", "demonstrations + answers", "meshes that differ", "rules that differ", "reason")


def list_failures(groups: Mapping[str, Mapping[str, Sequence[Session]]]) -> Table:
    """Every session that ended otherwise; groups: sessions by task, by condition."""
    every = (row for found in groups.values() for sessions in found.values() for row in sessions)
    rows = tuple(
        (
            row.task,
            row.condition,
            row.seed,
            f"{len(row.shown)} + {row.answers}",
            row.rounds[-1].differs,
            "; ".join(f"`{_short(learned)}` for `{_short(wanted)}`" for learned, wanted in _compare_rules(row)) or "–",
            reason(row),
        )
        for row in every
        if not row.right
    )
    return Table(
        "Sessions under true labels that ended with another behaviour (of other conditions: in the JSON)",
        COLUMNS,
        rows,
    )


def reason(row: Session) -> str:
    """Why a session ended otherwise, read off how large the rules are and how it ended; nothing is traced."""
    noisy = CONDITIONS[row.condition].labels != "true"
    if row.program is None:
        return "no program fits what was shown" + (", under wrong labels" if noisy else "")
    why = list(dict.fromkeys(_why(learned, wanted, noisy) for learned, wanted in _compare_rules(row)))
    if row.accepted:
        why.append("accepted, as no difference was among the twelve results looked at")
    else:
        why.append(f"given up after {len(row.shown)} demonstrations")
    return "; ".join(why)


def _why(learned: Rule, wanted: Rule, noisy: bool) -> str:
    ours, theirs = size_of(learned.extractor), size_of(wanted.extractor)
    if ours > theirs:
        return "a larger rule was learned, under wrong labels" if noisy else "a larger rule fits as well"
    if ours < theirs:
        told = "no demonstrated mesh tells the smaller rule from the one that is meant"
        return f"{told}, under its labels" if noisy else told
    return "a rule of the same size fits as well"


def _compare_rules(row: Session) -> list[tuple[Rule, Rule]]:
    if row.program is None:
        return []
    pairs = zip(Program.parse(row.program).rules, task(row.task).program.rules, strict=False)
    return [(learned, wanted) for learned, wanted in pairs if learned.extractor != wanted.extractor]


def _short(rule: Rule) -> str:
    return show(rule.extractor)


def pictures(rows: Sequence[Session], most: int = 12) -> Iterator[tuple[str, Image]]:
    """Of each task the first such session, of so many at most: a caption, and a mesh before, as learned, as meant."""
    first: dict[str, Session] = {}
    for row in sorted((r for r in rows if not r.right and r.program), key=lambda r: [*CONDITIONS].index(r.condition)):
        first.setdefault(row.task, row)
    for row in list(first.values())[:most]:
        if found := _choose_mesh(row):
            name, *meshes = found
            box, words = joint_bounds(*meshes), task(row.task).program.labels
            images = [
                render(mesh, color_by="label", size=_SIZE, legend=False, bounds=box, vocabulary=words)
                for mesh in meshes
            ]
            told = f"{row.task}, {name}, {row.condition}, seed {row.seed}"
            yield told, make_contact_sheet(images, 3, ["before", "as learned", "as meant"])


def _choose_mesh(row: Session) -> tuple[str, SymbolicMesh, SymbolicMesh, SymbolicMesh] | None:
    """The first mesh, of those that fail by the criterion before the others, that was edited otherwise; with the edit
    that is meant, the reference's under true labels."""
    labels = CONDITIONS[row.condition].labels
    if labels == "propagated":  # these changed on the way
        return None
    bench = open_bench(row.task, row.setting)
    desk = bench.desk(labels, row.seed)
    program = Program.parse(row.program or "")
    for name in dict.fromkeys([*row.failures, *bench.samples]):
        done, wanted, meant = (
            one.edit(rules, name)
            for one, rules in ((desk, program), (desk, bench.task.program), (bench.truth, bench.task.program))
        )
        if name in row.shown or not done.mesh or not wanted.mesh or not meant.mesh:
            continue
        if _list_selections(done) != _list_selections(wanted):
            sample = bench.samples[name]
            return name, upright(sample), upright(sample, done.mesh), upright(sample, meant.mesh)
    return None


def _list_selections(edited: EditResult) -> list[tuple[str, ...]]:
    return [tuple(sorted(line.selected)) for line in edited.trace]
