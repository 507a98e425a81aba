"""What is said where no extractor matches: plain sentences that name the hulls."""

from collections.abc import Sequence

import pytest

from meshforge.language import Delete, parse_extractor
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Answer, Demonstration, NoProgram, Options, Step, synthesize
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.diagnosis import give_advice
from meshforge.synthesis.search.smallest import NearestExtractor
from tests.synthesis_boxes import boxes

ROW = boxes(
    ("a", "leg", (0, 0, 0), (1, 1, 1)),
    ("b", "leg", (3, 0, 0), (1, 1, 1)),
    ("c", "bar", (6, 0, 0), (1, 1, 1)),
    ("d", None, (9, 0, 0), (1, 1, 1)),
    ("e", "all of it", (12, 0, 0), (1, 1, 1)),
)
MORE_THAN_ONE = "if what was shown follows different rules, make two steps of it"


def example(name: str, mesh: SymbolicMesh, *selected: str) -> Example:
    return Example(name, mesh, sum(1 << mesh.index[hull] for hull in selected))


def told(
    extra: Sequence[str],
    missing: Sequence[str],
    *examples: Example,
    extractor: str = "Is(leg)",
    answered: Sequence[str] = (),
) -> tuple[str, ...]:
    miss = NearestExtractor(parse_extractor(extractor), examples[0].name, tuple(extra), tuple(missing))
    return give_advice(miss, examples, answered)


@pytest.mark.parametrize(("extra", "missing", "said"), [
    (["a"], [], ("if 'a' of row is meant, too, show it; if not, is the label leg right?",
                 "if only a part of 'a' is meant, cut the hull (meshforge cut)")),
    (["a", "b"], [], ("if a, b of row are meant, too, show them; if not, is the label leg right?",)),
    (["a", "c"], [], ("if 'a' of row is meant, too, show it; if not, is the label leg right?",
                      "if 'c' of row is meant, too, show it; if not, is the label bar right?")),
    (["e"], [], ("if 'e' of row is meant, too, show it; if not, is the label \"all of it\" right?",
                 "if only a part of 'e' is meant, cut the hull (meshforge cut)")),
    (["d"], [], ("'d' of row has no label",
                 "if only a part of 'd' is meant, cut the hull (meshforge cut)")),
])  # fmt: skip
def test_hulls_too_much_are_named_by_label(extra: list[str], missing: list[str], said: tuple[str, ...]) -> None:
    assert told(extra, missing, example("row", ROW)) == said


def test_hulls_that_are_left_out_are_told_from_those_with_another_label() -> None:
    assert told([], ["c"], example("row", ROW, "a", "b", "c")) == (
        "'c' of row is labelled bar, while others that were shown are labelled leg: is that right?",
        "if only a part of 'c' is meant, cut the hull (meshforge cut)",
    )
    assert told([], ["a", "b"], example("row", ROW, "a", "b", "c", "e")) == (
        'a, b of row are labelled leg, while others that were shown are labelled "all of it", bar: is that right?',
    )
    assert told([], ["b"], example("row", ROW, "a", "b"))[0] == "is 'b' of row rightly labelled leg?"


def test_missing_labels_come_first_all_in_one_sentence() -> None:
    bare = ROW.with_labels({"a": None, "b": None})
    assert told(["b"], ["a"], example("row", bare, "a")) == ("a, b of row have no label",)


def test_of_many_hulls_the_first_are_named_and_the_others_counted() -> None:
    many = boxes(*((f"h{k}", "leg", (2 * k, 0, 0), (1, 1, 1)) for k in range(40)))
    said = told([f"h{k}" for k in range(40)], [], example("many", many))
    assert said == (
        "if h0, h1, h2, h3, h4 and 35 more of many are meant, too, show them; if not, is the label leg right?",
    )


def test_a_contact_that_is_missed_by_little_is_named_with_its_distance() -> None:
    near = boxes(
        ("top", "panel", (0, 0, 1.004), (1, 1, 0.1)),
        ("leg", "leg", (0, 0, 0), (0.1, 0.1, 1)),
        ("far", "leg", (0.5, 0.5, 0), (0.1, 0.1, 0.5)),
    )
    said = told([], ["leg"], example("table", near, "leg"), extractor="Diff(Attach(Is(leg), Is(panel)), Is(misc))")
    assert said[0] == (
        "'leg' and 'top' of table are 0.004 m apart, just too far to count as touching: "
        "a larger threshold `contact` would join them"
    )
    other = told([], ["leg"], example("table", near, "leg"), extractor="Attach(Is(leg), Is(misc))")
    assert not any("apart" in line for line in other)


def test_answers_can_be_taken_back() -> None:
    row, other = example("row", ROW, "a"), example("other", ROW, "b")
    assert "an answer was given for row: it can be taken back" in told(["b"], [], row, answered=["row"])
    assert "answers were given for row, other: they can be taken back" in told(
        ["b"], [], row, other, answered=["row", "other"]
    )
    assert not any("answer" in line for line in told(["b"], [], row))


def test_what_was_shown_on_several_meshes_may_be_two_rules() -> None:
    row, other = example("row", ROW, "a"), example("other", ROW, "b")
    assert told(["b"], [], row, other)[-1] == MORE_THAN_ONE
    assert MORE_THAN_ONE not in told(["b"], [], row, example("other", ROW)), "nothing to do is no other rule"


def test_no_more_is_said_than_a_person_reads_and_nothing_twice() -> None:
    assert len(told(["a", "c", "d", "e"], [], example("row", ROW, "b"), example("other", ROW, "b"))) == 4
    single = boxes(("only", "leg", (0, 0, 0), (1, 1, 1)))
    assert told(["only"], [], example("single", single)) == (
        "if 'only' of single is meant, too, show it; if not, is the label leg right?",
    )


def test_an_outcome_without_a_program_carries_the_advice_and_names_answers_of_that_rule_only() -> None:
    demo = Demonstration(ROW, [Step(1, {"a", "b"}, Delete())], "row")
    batch = {"x": ROW.with_labels({})}
    answers = [Answer(1, "x", {"a"}), Answer(2, "x", {"b"}), Answer(1, "row", {"a"}), Answer(1, "gone", {"a"})]
    outcome = synthesize([demo], batch, answers=answers, options=Options(repair=False))
    assert isinstance(outcome, NoProgram)
    assert outcome.why == (
        "'b' of row was selected and 'b' of x was not, yet every extractor treats them alike; "
        "a label of its own for one of them would tell them apart"
    )
    assert "an answer was given for x: it can be taken back" in outcome.advice
