"""Families signed off in a project on disk: what is written reads back, and each client of a person does the same."""

import json
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from benchmark.assets import family
from benchmark.signoff.client import Client
from benchmark.signoff.judge import Judge, Output, run_on_desk
from benchmark.signoff.product_before import FROZEN, list_units, measure, read, write
from benchmark.signoff.queue import DONE, ReviewCourse, sign_off
from benchmark.signoff.reviewer import Reviewer
from benchmark.signoff.sessions import Unit
from benchmark.signoff.terminal import AnswersClient, TerminalClient, WrongClient
from benchmark.study import TRUE, Bench
from benchmark.study.condition import PROPAGATED
from benchmark.study.project import name_by_files, open_project
from benchmark.tasks import task
from meshforge.geometry import digest
from meshforge.label_model import FamilyModel
from meshforge.signoff import ReviewReply


def open_few(name: str, count: int) -> Bench:
    one = task(name)
    return name_by_files(Bench(one, family(one.category, "coarse")[:count]))


@pytest.fixture(scope="module")
def bench() -> Bench:
    return open_few("cup-easy", 4)


def test_a_project_holds_the_hulls_labels_orientation_and_templates_of_its_family() -> None:
    bench = open_few("cup-hard", 3)
    desk = bench.desk("telling", 1)
    with open_project(desk) as project:
        assert project.orientation == bench.task.program.orient
        assert project.vocabulary == bench.task.program.labels
        templates = project.templates(bench.task.templates)
        for name, template in bench.task.templates.items():
            assert list(map(digest, templates[name].shapes)) == list(map(digest, template.shapes))
        for name, mesh in desk.meshes.items():
            read = project.mesh(name)
            assert [digest(hull.shape) for hull in read.hulls] == [digest(hull.shape) for hull in mesh.hulls]
            assert dict(read.labels) == dict(mesh.labels)
            assert read.contacts == mesh.contacts
    assert not project.folder.exists()


def test_labels_taken_by_the_product_are_those_of_its_model_of_the_family(bench: Bench) -> None:
    desk = bench.desk("flat", 1)
    said = [hull.annotation for mesh in desk.meshes.values() for hull in mesh.hulls]
    agreed = FamilyModel(list(bench.truth.meshes.values())).infer(said).agree(said)
    with open_project(desk) as project:
        client = Client(project)
        client.take_labels()
        taken = [hull.label for mesh in client.read_meshes().values() for hull in mesh.hulls]
    assert taken == [label and label.name for label in agreed]
    with open_project(bench.desk("propagated", 1)) as project:
        client = Client(project)
        client.take_labels()
        assert not any(mesh.labels for mesh in client.read_meshes().values())


@pytest.mark.parametrize("condition", [TRUE, PROPAGATED[0]])
def test_commands_alone_come_to_the_same_as_methods(bench: Bench, condition: object) -> None:
    one, other = (sign_off(bench, condition, 1, client) for client in (Client, TerminalClient))  # type: ignore[arg-type]
    assert one.ended == DONE
    assert replace(other, first=one.first) == one


@pytest.mark.parametrize(("make", "says"), [(Client, True), (AnswersClient, True), (WrongClient, False)])
def test_who_says_wrong_says_which_hulls_are_right(bench: Bench, make: type[Client], says: bool) -> None:
    reviewer = Reviewer(bench, 1, TRUE)
    with open_project(bench.truth) as project:
        client = make(project)
        course = ReviewCourse(bench.truth, TRUE, 1, reviewer, client)
        first, second, *_ = bench.samples
        client.demonstrate(first, reviewer.shows(course.desk, first).steps)
        course.shown.append(first)
        while (question := client.review().question) and question.kind != "result":
            client.reply(question, ReviewReply(question.id, later=True))
        assert question
        output = client.read_output(question.asset)
        assert output and output.selections
        trace = [replace(line, selected=()) for line in output.edited.trace]
        odd = replace(output, edited=replace(output.edited, trace=tuple(trace)))
        course._correct(question, ReviewReply(question.id, "wrong"), odd)
        (verdict,) = project.feedback().verdicts[question.asset]
        meant = tuple(frozenset(one.select) for one in verdict.meant)
        assert meant == (bench.truth.reference[question.asset] if says else ())
        assert reviewer.ledger.acts["correction"] == says
        assert second in project.assets()


def test_an_edit_by_hand_is_right_where_its_hulls_are_those_that_are_wanted(bench: Bench) -> None:
    judge, name = Judge(bench), next(iter(Judge(bench).possible))
    right = run_on_desk(bench.truth, bench.task.program, name)
    nothing = run_on_desk(bench.truth, replace(bench.task.program, rules=()), name)
    assert right and nothing
    assert judge.is_right(name, right)
    assert judge.is_right(name, Output(right.edited, by_hand=True))
    assert not judge.is_right(name, nothing)
    assert not judge.is_right(name, Output(nothing.edited, by_hand=True))


def test_frozen_sessions_read_back_and_have_a_page(bench: Bench, tmp_path: Path) -> None:
    review = sign_off(bench, TRUE, 1)
    found = {"review": json.loads(json.dumps(asdict(review))), "computer": 1.0}
    write(tmp_path / "frozen.json", [(Unit("cup-easy", TRUE.name, 1), found)], "abc")
    commit, ((client, kept),) = read(tmp_path / "frozen.json")
    assert commit == "abc"
    assert client == Client.name
    assert kept == replace(review, points=review.points[-1:])
    assert len(set(list_units())) == len(list_units())
    if FROZEN.exists():
        result = measure(lambda _: None, quick=True)
        assert all(len(row) == len(table.columns) for table in result.tables for row in table.rows)
