"""RQ1: whether programs are learned from few demonstrations, and whether the edited meshes do what they are for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from benchmark.evaluation import paper
from benchmark.evaluation.failures import list_failures
from benchmark.evaluation.figures import (
    LEVELS,
    Groups,
    by_task,
    confirmations,
    count_solved,
    demonstrations,
    format_pair,
    fpr,
    fpr_pure,
    of_difficulty,
    share_solved_at,
    spread,
    synthesis,
)
from benchmark.evaluation.sessions import sessions
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.study import CONDITIONS, FULL, NOISY, Session
from benchmark.study.keystrokes import model_seconds
from benchmark.tasks import DIFFICULTIES, task

OWN, SILENT, NOISY_SILENT = (
    CONDITIONS[name] for name in ("true labels, own choice", "true labels, no questions", "noisy labels, no questions")
)
RANDOM, NOISY_RANDOM = (CONDITIONS[f"{labels} labels, random dozen"] for labels in ("true", "noisy"))
ERRS = CONDITIONS["noisy labels, errs in 5%"]
CARRIED = tuple(CONDITIONS[f"propagated labels, {count} labelled"] for count in (1, 3))
ASKED = (FULL, RANDOM, OWN, SILENT, NOISY, NOISY_RANDOM, NOISY_SILENT, ERRS, *CARRIED)
KS = range(1, 9)


def measure(tell: Tell, quick: bool) -> Result:
    """Teach all tasks, with true labels and noisy ones, with questions and without."""
    return summarize(sessions(ASKED, tell, quick), "effectiveness", "RQ1: effectiveness")


def summarize(rows: Sequence[Session], part: str, title: str) -> Result:
    """What sessions under all these conditions come to."""
    groups = {condition.name: by_task(rows, condition.name) for condition in ASKED}
    true, noisy = groups[FULL.name], groups[NOISY.name]
    return Result(
        part,
        title,
        (
            _levels("True labels", true),
            _levels("Noisy labels, repair on", noisy),
            _conditions(groups),
            _few_shot(groups),
            _phases(groups),
            _tasks(true, noisy),
            list_failures({one.name: groups[one.name] for one in (FULL, RANDOM, OWN, SILENT, NOISY)}),
        ),
        tuple(_goals(groups)),
        tuple(_notes(true)),
        tuple(row.to_json() for row in rows),
    )


def _levels(title: str, groups: Groups) -> Table:
    columns = (
        "difficulty",
        "N",
        "demonstrations (paper)",
        "demonstrations",
        "answers",
        "k = both",
        "SSR (paper)",
        "SSR",
        "FPR (paper)",
        "FPR",
        "FPR, pure meshes",
        "synthesis, s (paper)",
        "synthesis, s",
    )
    return Table(title, columns, tuple(_level(level, of_difficulty(groups, level)) for level in LEVELS))


def _level(level: str, groups: Groups) -> tuple[Cell, ...]:
    _, demos, ssr, functional, seconds = paper.RQ1[level]
    return (
        level,
        len(groups),
        demos,
        format_pair(spread(groups, demonstrations), 1),
        format_pair(spread(groups, lambda row: row.answers), 1),
        format_pair(spread(groups, lambda row: row.k), 1),
        ssr,
        f"{count_solved(groups)}/{len(groups)}",
        functional,
        format_pair(spread(groups, fpr)),
        format_pair(spread(groups, fpr_pure)),
        seconds,
        format_pair(spread(groups, synthesis)),
    )


def _conditions(groups: dict[str, dict[str, list[Session]]]) -> Table:
    asked = ("labels given", "confirmations", "of these right, %")
    right = ("SSR", "sessions right", "right if labels were")
    columns = ("condition", *right, "k", *asked, "F1", "FPR", "settled, %", "settled but wrong")
    rows = []
    for name, found in groups.items():
        every = [row for sessions in found.values() for row in sessions]
        proposed = sum(row.confirmed + row.refused for row in every)
        accepted = [row for row in every if row.accepted]
        rows.append(
            (
                name,
                f"{count_solved(found)}/{len(found)}",
                f"{sum(row.right for row in every)}/{len(every)}",
                f"{sum(row.right_on_true for row in every)}/{len(every)}",
                format_pair(spread(found, lambda row: row.k), 1),
                format_pair(spread(found, lambda row: row.typed), 0),
                format_pair(spread(found, confirmations), 1),
                100 * sum(row.confirmed for row in every) / proposed if proposed else "–",
                format_pair(spread(found, lambda row: row.f1), 3),
                format_pair(spread(found, fpr)),
                100 * sum(row.settled for row in accepted) / max(len(accepted), 1),
                sum(row.settled and not row.right for row in accepted),
            )
        )
    absent = ("labels of a VLM", *["not run"] * (len(columns) - 1))
    return Table("All conditions", columns, (*rows, absent))


def _few_shot(groups: dict[str, dict[str, list[Session]]]) -> Table:
    columns = ("condition", "difficulty", *(f"k = {k}" for k in KS))
    rows: list[tuple[Cell, ...]] = [("paper", "all", *(paper.FEW_SHOT.get(k, "") for k in KS))]
    for condition in (FULL, RANDOM, OWN, SILENT, NOISY):
        for level in LEVELS:
            found = of_difficulty(groups[condition.name], level)
            rows.append((condition.name, level, *(100 * share_solved_at(found, k) for k in KS)))
    return Table("SSR at k demonstrations plus answers, %", columns, tuple(rows))


def _phases(groups: dict[str, dict[str, list[Session]]]) -> Table:
    spent = ("demonstrating", "answering", "confirming", "looking at results")
    rows = []
    for condition in (FULL, NOISY):
        found = groups[condition.name]
        tool = [spread(found, partial(_tool_seconds, part=part)) for part in ("search", "replay")]
        person = [spread(found, partial(_person_seconds, part=part)) for part in spent]
        rows.append((condition.name, *(format_pair(x) for x in tool), *(format_pair(x, 0) for x in person)))
    title = "Time by phase, s a task: the tool's is measured, the person's is modelled by keystrokes"
    return Table(title, ("condition", "search", "replay", *spent), tuple(rows))


def _tool_seconds(row: Session, part: str) -> float:
    return sum(r.seconds.get(part, 0.0) for r in row.rounds)


def _person_seconds(row: Session, part: str) -> float:
    return model_seconds(row, len(task(row.task).program.rules))[part]


def _tasks(true: Groups, noisy: Groups) -> Table:
    columns = (
        "task",
        "rules",
        "k",
        "SSR",
        "FPR",
        "FPR, pure",
        "pure meshes",
        "noisy: k",
        "SSR",
        "FPR",
        "confirmations",
    )
    return Table("Task by task", columns, tuple(_task(name, true[name], noisy.get(name, [])) for name in true))


def _task(name: str, true: Sequence[Session], noisy: Sequence[Session]) -> tuple[Cell, ...]:
    one, other = {name: true}, {name: noisy}
    judged = sum(row.judged for row in true)
    return (
        name,
        len(task(name).program.rules),
        spread(one, lambda row: row.k)[0],
        f"{sum(row.right for row in true)}/{len(true)}",
        spread(one, fpr)[0],
        spread(one, fpr_pure)[0],
        f"{100 * sum(row.judged_pure for row in true) / max(judged, 1):.0f}%",
        spread(other, lambda row: row.k)[0],
        f"{sum(row.right for row in noisy)}/{len(noisy)}",
        spread(other, fpr)[0],
        spread(other, confirmations)[0],
    )


def _goals(groups: dict[str, dict[str, list[Session]]]) -> Iterator[Goal]:
    true, noisy = groups[FULL.name], groups[NOISY.name]
    every = [row for rows in true.values() for row in rows]
    accepted = [row for row in every if row.accepted]
    many = max(len(true), 1)
    yield Goal("tasks synthesized, true labels, %", "at least", 100.0, 100 * count_solved(true) / many)
    yield Goal("tasks synthesized, noisy labels with repair, %", "at least", 100.0, 100 * count_solved(noisy) / many)
    for k, wanted in ((1, 60.0), (2, 90.0), (3, 100.0)):
        yield Goal(f"SSR at k = {k}, %", "at least", wanted, 100 * share_solved_at(true, k))
    yield Goal("demonstrations plus answers a task, mean", "at most", 1.8, spread(true, lambda row: row.k)[0])
    among = [known for row in every for known in row.known_among]
    yield Goal("true behaviour among the readings, % of rules", "at least", 99.0, 100 * sum(among) / max(len(among), 1))
    settled = [row for row in accepted if row.settled]
    yield Goal("settled, % of accepted runs", "at least", 90.0, 100 * len(settled) / max(len(accepted), 1))
    yield Goal("settled, yet wrong", "at most", 0.0, float(sum(not row.right for row in settled)))
    replayed = max((_tool_seconds(row, "replay") / len(row.rounds) for row in every), default=0.0)
    yield Goal("replay over the batch, slowest task, a round, s", "at most", 1.0, replayed)
    yield Goal("functional pass rate, pure meshes", "at least", 0.98, spread(true, fpr_pure)[0])
    yield Goal("the same, hard tasks", "at least", 0.96, spread(of_difficulty(true, DIFFICULTIES[-1]), fpr_pure)[0])
    yield Goal("noisy labels: confirmations a task", "at most", 1.5, spread(noisy, confirmations)[0])
    rows = [row for sessions in noisy.values() for row in sessions]
    asked = sum(row.confirmed + row.refused for row in rows)
    right = 100 * sum(row.confirmed for row in rows) / asked if asked else 100.0
    yield Goal("noisy labels: proposed corrections that are right, %", "at least", 95.0, right)


def _notes(true: Groups) -> Iterator[str]:
    yield paper.CONDITIONS
    yield (
        "*SSR*: tasks in which all five demonstrators end with a program whose selections are the reference's on every "
        "mesh that was not demonstrated, under the same labels. *k*: demonstrations plus answers to the tool's "
        "questions. *FPR*: share of those meshes whose edit meets the task's criterion; *pure*: no hull that the rules "
        "are about was made of several parts."
    )
    yield (
        "*Own choice*: of meshes on which equally many rules have something to do, the person begins with any; in "
        "all other conditions, with the one that the tool proposes."
    )
    yield (
        "*Random dozen*: before accepting, a person looks at twelve results drawn at random, and does not report "
        "them to the tool; in all other conditions, at those that the tool proposes, and reports which ones are "
        "right (decision 0018). *Right if labels were*: sessions whose program selects the same hulls as the "
        "reference on the same meshes with true labels."
    )
    yield (
        "*Propagated labels*: a person labels one mesh, or three, as advised, and checks the labels of each "
        "demonstrated mesh; all other labels are propagated. *Labels given*: by hand, a session; meshes labelled "
        "before are not judged. F1 and FPR are against true labels throughout."
    )
    yield (
        "Where figures miss their goal. A question counts as much as a demonstration here, though it takes a third "
        "of the time. If no question is answered, as many sessions end right with a lower k, since the proposed "
        "results show what the questions would ask. We keep the questions for people who do not look at results: if "
        "a question must save 0.6 instead of 0.4 demonstrations, k is 1.8 on the calibration set (decision 0016). "
        "One demonstration says nothing about parts that only other meshes have; people see these when they look at "
        "results."
    )
    yield (
        "Under noisy labels, sessions that end with another behaviour have rules that agree with the reference on "
        "all demonstrated meshes and results that the person looked at. Some select the same hulls wherever labels "
        "are right (*right if labels were*), so that only a mesh with wrong labels shows a difference. The others "
        "differ on meshes that the person did not look at, or were demonstrated on meshes with wrong labels. We did "
        "not trace them, since traces are for the calibration set (decision 0019)."
    )
    yield "The reasons in the table of failing sessions follow from the size of the rules and how a session ended."
