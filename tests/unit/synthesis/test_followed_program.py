"""What became of a program that somebody had in mind, told in sentences."""

from __future__ import annotations

from dataclasses import replace

import pytest

from benchmark.learning.families import family
from meshforge.language import Delete, Is, LandmarkPair, Orient, Program, show
from meshforge.synthesis import Demonstration, Options, Step, synthesize
from meshforge.synthesis.options import Layers
from tests.synthesis_cupboards import cupboards, shown

MESHES = cupboards()
HANDLES = "Is(handle) => Delete"


def followed(
    wanted: str, demonstrated: str = HANDLES, orient: Orient | None = None, options: Options | None = None
) -> tuple[str, ...]:
    return synthesize(
        shown(MESHES, ["c0"], demonstrated),
        MESHES,
        orient=orient,
        options=replace(options or Options(repair=False), follow=Program.parse(wanted)),
    ).followed


def test_without_a_program_to_follow_nothing_is_told() -> None:
    assert synthesize(shown(MESHES, ["c0"], HANDLES), MESHES).followed == ()


@pytest.mark.parametrize(("wanted", "told"), [
    ("Is(handle)", "learned"),
    ("Union(Is(handle), Is(handle))", "learned as Is(handle), which selects the same on every asset"),
    ("Geo(Is(handle), -Z)", "reading 1.2; Is(handle) is more believable ({}). "
                            "They differ on 4 assets: c1, c3, c5, c7; demonstrate one of these"),
    ("Attach(Is(handle), Is(drawer))",
     "reading 1.2 as Geo(Is(handle), -Z), which selects the same on every asset; Is(handle) is more believable "
     "({}). They differ on 4 assets: c1, c3, c5, c7; demonstrate one of these"),
    ("Is(door)", "on c0 it leaves out pull"),
    ("Is(body)", "on c0 it leaves out pull and selects case too"),
    ("All", "on c0 it selects case, drawer too"),
    ("Is(knob)", "the label knob is not in the vocabulary"),
    ('Is("all of it")', 'the label "all of it" is not in the vocabulary'),
])  # fmt: skip
def test_each_rule_is_told_of_in_one_sentence(wanted: str, told: str) -> None:
    first, second, *_ = synthesize(shown(MESHES, ["c0"], HANDLES), MESHES, options=Options(repair=False)).candidates
    shares = f"{first.belief:.0%} against {second.belief:.0%}"
    assert followed(f"{wanted} => Delete") == (f"rule 1, {wanted}: {told.format(shares)}",)


def test_one_asset_is_it_and_not_one_of_these() -> None:
    few = {name: MESHES[name] for name in ("c0", "c1", "c2")}
    options = Options(follow=Program.parse("Geo(Is(handle), -Z) => Delete"))
    outcome = synthesize(shown(few, ["c0"], HANDLES), few, options=options)
    (line,) = outcome.followed
    assert line.endswith("They differ on 1 asset: c1; demonstrate it")


def test_a_larger_reading_that_is_believed_more_but_not_taken_is_told_so() -> None:
    meshes = {f"t{k}": mesh for k, mesh in enumerate(family("cabinet", 12, seed=5))}
    demos = shown(meshes, ["t1"], "Attach(Is(handle), Is(drawer)) => Delete")
    beliefs = {r.extractor: r.belief for r in synthesize(demos, meshes, options=Options(repair=False)).candidates}
    taken, rival, *_ = beliefs
    assert beliefs[taken] < beliefs[rival], "else this family shows nothing"
    options = Options(repair=False, follow=Program.parse(f"{show(rival)} => Delete"))
    (line,) = synthesize(demos, meshes, options=options).followed
    assert f"; {show(taken)} is smaller, though less believable ({beliefs[taken]:.0%} against" in line


@pytest.mark.parametrize(("layers", "wanted", "told"), [
    ("S+G", "Diff(Is(handle), Attach(Is(handle), Is(door)))", "Attach is switched off (layers S+G)"),
    ("S+T", "Geo(Is(handle), -Z)", "Geo is switched off (layers S+T)"),
    ("S", "Is(handle)", "learned"),
])  # fmt: skip
def test_what_is_switched_off_cannot_be_learned(layers: Layers, wanted: str, told: str) -> None:
    assert followed(f"{wanted} => Delete", options=Options(layers=layers, repair=False)) == (
        f"rule 1, {wanted}: {told}",
    )


def test_what_is_larger_than_the_search_goes_cannot_be_learned() -> None:
    wanted = "Diff(Is(handle), Is(door))"
    assert followed(f"{wanted} => Delete", options=Options(max_size=2, repair=False)) == (
        f"rule 1, {wanted}: it has 3 nodes, and the search ends at 2",
    )


def test_what_is_larger_than_readings_are_is_told_so() -> None:
    wanted = "Union(Is(handle), Geo(Is(foot), -X))"
    assert followed(f"{wanted} => Delete", options=Options(above=1, repair=False)) == (
        f"rule 1, {wanted}: it selects what was shown, but has 4 nodes where 1 suffices",
    )
    two = followed("Attach(Is(drawer), Is(body)) => Delete", "Geo(All, +Z) => Delete", options=Options(above=0))
    assert two == ("rule 1, Attach(Is(drawer), Is(body)): on c0 it leaves out case and selects drawer too",)


def test_readings_that_were_too_many_to_look_at_are_told_of() -> None:
    (line,) = followed("Union(Is(foot), Is(handle)) => Delete", options=Options(effort=0, repair=False))
    assert line == (
        "rule 1, Union(Is(foot), Is(handle)): "
        "it selects what was shown, but there were too many readings to get that far"
    )


def test_a_search_that_ran_out_of_time_did_not_get_that_far() -> None:
    wanted = "Union(Is(body), Is(handle))"
    (line,) = followed(f"{wanted} => Delete", f"{wanted} => Delete", options=Options(budget=0))
    assert line == f"rule 1, {wanted}: it selects what was shown, but the search did not get that far"


def test_the_strategy_of_the_paper_takes_the_first_that_matches() -> None:
    options = Options(strategy="paper", repair=False)
    assert followed(HANDLES, options=options) == ("rule 1, Is(handle): learned",)
    assert followed("Geo(Is(handle), -Z) => Delete", options=options) == (
        "rule 1, Geo(Is(handle), -Z): it selects what was shown, but Is(handle) comes before it",
    )


def test_rules_too_many_and_too_few_are_counted() -> None:
    two = "Is(body) => Delete\nIs(handle) => Delete\n"
    assert followed(two)[0] == "1 rule is demonstrated, not 2"
    assert len(followed(two)) == 2, "the second rule has no demonstration to hold it against"
    assert followed("", two) == ("2 rules are demonstrated, not 0",)
    assert followed("Is(body) => Delete", two) == ("2 rules are demonstrated, not 1", "rule 1, Is(body): learned")


def test_another_orientation_is_named_before_the_rules() -> None:
    up = Orient((LandmarkPair("+Z", Is("drawer"), Is("body")),))
    assert followed(f"{show(up)}\n{HANDLES}")[0] == (
        "it has orient +Z: Is(drawer) -> Is(body), the demonstrations were looked at with no orientation"
    )
    assert followed(HANDLES, orient=up)[0] == (
        "it has no orientation, the demonstrations were looked at with orient +Z: Is(drawer) -> Is(body)"
    )
    assert followed(f"{show(up)}\n{HANDLES}", orient=up)[0].startswith("rule 1")


def test_a_rule_that_nothing_matches_is_told_of_and_those_after_it_are_not() -> None:
    steps = [Step(1, {"pull"}, Delete()), Step(2, {"foot0"}, Delete()), Step(3, {"case"}, Delete())]
    outcome = synthesize(
        [Demonstration(MESHES["c2"], steps, "c2")],
        options=Options(
            repair=False,
            layers="S",
            follow=Program.parse("Is(handle) => Delete\nIs(foot) => Delete\nIs(body) => Delete"),
        ),
    )
    assert outcome.status == "none"
    assert outcome.followed == ("rule 1, Is(handle): learned", "rule 2, Is(foot): on c2 it selects foot1 too")
