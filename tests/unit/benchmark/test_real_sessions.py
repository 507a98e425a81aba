"""What sessions on real families come to: the worst family is named and stands last, and decides a goal."""

from benchmark.evaluation.real_sessions import find_goals, tell_families
from benchmark.study import FLAT, TRUE, Round, Session


def session(family: str, difficulty: str, setting: str, *, right: bool, condition: str = TRUE.name) -> Session:
    rounds = [Round(1, 0, 0 if right else 3)]
    name = f"real-{family}-{difficulty}"
    return Session(name, condition, 100, setting, rounds=rounds, shown=["a"], right=right, judged=8)


ROWS = [
    session("tables", "easy", "as_is", right=True),
    session("tables", "hard", "fine", right=True),
    session("cups", "easy", "as_is", right=True),
    session("cups", "easy", "fine", right=False),
    session("cups", "easy", "fine", right=True, condition=FLAT.name),
]


def test_the_worst_family_stands_last_and_all_after_it() -> None:
    table = tell_families(ROWS)
    assert [row[:2] for row in table.rows] == [
        (TRUE.name, "tables"),
        (TRUE.name, "cups"),
        (TRUE.name, "all"),
        (FLAT.name, "cups"),
        (FLAT.name, "all"),
    ]
    ssr, right = table.columns.index("SSR"), table.columns.index("sessions right")
    assert [(row[ssr], row[right]) for row in table.rows[:3]] == [("2/2", "2/2"), ("0/1", "1/2"), ("2/3", "3/4")]


def test_one_bad_family_fails_its_goal_and_the_goal_of_all() -> None:
    solved, worst, settled = find_goals(ROWS)
    assert round(solved.measured, 1) == 66.7
    assert "cups" in worst.what
    assert worst.measured == 50.0
    assert (solved.reached, worst.reached, settled.reached) == (False, False, True)
    wrong = session("cups", "easy", "as_is", right=False)
    wrong.accepted = wrong.settled = True
    assert find_goals([*ROWS, wrong])[2].measured == 1.0
