from pathlib import Path

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from meshforge.common import ProjectError, UsageError
from meshforge.language import Action, Delete, Each, Merge, Replace, Scale
from meshforge.project import Project
from meshforge.synthesis import Answer, Step
from tests.examples import examples
from tests.unit.batch.families import tree
from tests.unit.project.tables import FIRST, LEGS, SECOND, THIRD, labelled

ACTIONS: tuple[Action, ...] = (Delete(), Each(Merge()), Replace("box"), Scale("all", 2.0))
NAMES = ("crumb", "top", "left_low", "right_low")


def steps(*kinds: str) -> list[Step]:
    """Steps 1, 2, 3 and so on, each with an action and a hull of its own: shown, nothing here, or open."""
    return [
        Step(rule, {"shown": [NAMES[rule - 1]], "nothing": [], "open": None}[kind], ACTIONS[rule - 1])
        for rule, kind in enumerate(kinds, 1)
    ]


def said(project: Project, asset: str) -> list[tuple[int, set[str] | None, Action]]:
    return [(s.rule, None if s.select is None else set(s.select), s.action) for s in project.steps(asset)]


def three(folder: Path) -> Project:
    project = labelled(folder)
    project.demonstrate(FIRST, steps("shown", "shown", "shown"))
    project.demonstrate(SECOND, steps("shown"))
    return project


def test_a_rule_is_taken_out_of_all_demonstrations(tmp_path: Path) -> None:
    project = three(tmp_path)
    project.delete_rule(1)
    assert said(project, FIRST) == [(1, {"top"}, ACTIONS[1]), (2, {"left_low"}, ACTIONS[2])]
    assert not project.layout.demonstration(SECOND).exists()


def test_a_demonstration_of_open_steps_stays_until_none_is_left(tmp_path: Path) -> None:
    project = three(tmp_path)
    project.demonstrate(SECOND, steps("shown", "open"))
    project.delete_rule(1)
    assert said(project, SECOND) == [(1, None, ACTIONS[1])]
    project.delete_rule(1)
    assert not project.layout.demonstration(SECOND).exists()
    project.delete_rule(1)
    assert project.demonstrations() == {}


def test_answers_go_with_their_rules(tmp_path: Path) -> None:
    project = three(tmp_path)
    for rule in (1, 2, 3):
        project.add_answer(Answer(rule, THIRD, LEGS))
    project.move_rule(3, 1)
    actions = {line.id: line.action for line in project.feedback().answers.values()}
    assert actions == {f"1:{THIRD}": str(ACTIONS[2]), f"2:{THIRD}": "Delete", f"3:{THIRD}": "Merge"}
    project.delete_rule(2)
    actions = {line.id: line.action for line in project.feedback().answers.values()}
    assert actions == {f"1:{THIRD}": str(ACTIONS[2]), f"2:{THIRD}": "Merge"}
    project.delete_rule(1)
    project.delete_rule(1)
    assert not project.feedback().answers


@pytest.mark.parametrize(("rule", "to"), [(0, 1), (4, 1), (1, 0), (1, 4), (-1, 2)])
def test_a_rule_that_does_not_exist_is_refused(tmp_path: Path, rule: int, to: int) -> None:
    project = three(tmp_path)
    before = tree(project.folder)
    with pytest.raises(UsageError, match="rules 1 to 3 are demonstrated"):
        project.move_rule(rule, to)
    assert tree(project.folder) == before


def test_steps_that_someone_numbered_otherwise_are_refused_with_nothing_changed(tmp_path: Path) -> None:
    project = three(tmp_path)
    path = project.layout.demonstration(SECOND)
    path.write_text(path.read_text().replace('"rule": 1', '"rule": 2'))
    before = tree(project.folder)
    with pytest.raises(ProjectError, match="not numbered in order"):
        project.delete_rule(1)
    assert tree(project.folder) == before


def test_what_a_newer_version_keeps_in_a_step_moves_with_it(tmp_path: Path) -> None:
    project = three(tmp_path)
    path = project.layout.demonstration(SECOND)
    path.write_text(path.read_text().replace('"rule": 1,', '"rule": 1, "remark": "mine",'))
    project.move_rule(1, 2)
    assert '"remark": "mine"' in path.read_text()


KINDS = st.lists(st.sampled_from(["shown", "nothing", "open"]), max_size=4)


@examples(30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(demos=st.tuples(KINDS, KINDS, KINDS), data=st.data())
def test_moving_keeps_what_each_asset_says_about_each_rule(
    tmp_path_factory: pytest.TempPathFactory, demos: tuple[list[str], ...], data: st.DataObject
) -> None:
    project = labelled(tmp_path_factory.mktemp("p"))
    for asset, kinds in zip((FIRST, SECOND, THIRD), demos, strict=True):
        project.demonstrate(asset, steps(*kinds))
    most = max(map(len, demos))
    if not most:
        return
    rule, to = (data.draw(st.integers(1, most)) for _ in range(2))
    before = {asset: {s.rule: s.select for s in project.steps(asset) if not s.open} for asset in project.assets()}
    project.move_rule(rule, to)
    order = list(range(1, most + 1))
    order.insert(to - 1, order.pop(rule - 1))
    for asset in project.assets():
        now = project.steps(asset)
        assert {order[step.rule - 1]: step.select for step in now if not step.open} == before[asset]
        assert all(step.action == ACTIONS[order[step.rule - 1] - 1] for step in now)
    assert max(len(project.steps(asset)) for asset in project.assets()) == most
