"""What demonstrations leave open, and how much of it questions settle: rules and whole programs of known meaning.

Nothing was fitted or tuned on the families measured here.
"""

from __future__ import annotations

from benchmark.learning.cases import cases
from benchmark.learning.program_courses import programs_tables
from benchmark.learning.rule_courses import RuleCourse, learn_rule, percent, rules_tables
from benchmark.report import Goal, Result, Tell

SEEDS = range(100, 105)
COUNTS = (1, 2, 3)
_PROGRAM_SEEDS, _PROGRAM_COUNTS = range(100, 102), (1, 2)


def measure(tell: Tell, quick: bool) -> Result:
    """Learn every rule and program from few demonstrations, and answer questions by the truth."""
    rows: list[RuleCourse] = []
    for count in COUNTS[:2] if quick else COUNTS:
        for case in cases(SEEDS[:1], count, ("lamp",)) if quick else cases(SEEDS, count):
            rows.append(learn_rule(case, count))
            tell(f"rules: {len(rows)} learned")
    programs, details = programs_tables(
        tell, _PROGRAM_SEEDS[:1] if quick else _PROGRAM_SEEDS, _PROGRAM_COUNTS, ("lamp",) if quick else None
    )
    near = [row.among for row in rows if row.near]
    settled_wrong = sum(row.settled and not row.right for row in rows)
    settled_wrong += sum(row["settled"] and row["wrong"] > 0 for row in details)
    goals = (
        Goal("hidden behaviour among the readings, of the near, %", "at least", 99.0, percent(near)),
        Goal("rules and programs that are settled, yet wrong", "at most", 0.0, float(settled_wrong)),
    )
    return Result(
        "asking",
        "Demonstrations and answers",
        (*rules_tables(rows), *programs),
        goals,
        (
            f"Rules: {len({row.rule for row in rows})} hidden extractors on families of 30 meshes, with demonstrations "
            "drawn blindly of the meshes where they select something; label repair off, as all labels are right.",
            "A person answers by the truth: the choice that is right, or *neither*; then the next question is asked, "
            "until none is worth it. *Settled*: all believable readings do the same on every mesh.",
            "*Near*: the hidden extractor has at most four nodes more than the smallest that fits; only such readings "
            "are looked for.",
            "Programs: three to five rules, everything on; the first demonstration is drawn of the meshes on which "
            "every rule selects something, further ones of all. Proposals to repair a label are refused, as all are "
            "right.",
        ),
        (*(row.to_json() for row in rows), *details),
    )
