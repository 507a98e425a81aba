"""Sentences about rules."""

import pytest

from meshforge.language import Program, explain, parse_extractor
from tests.program_parts import parse_orient

_SENTENCES = [
    ("Is(misc) => Delete", "The misc hulls are deleted."),
    (
        "Is(panel) => Replace(box)",
        "The panel hulls are replaced by a box that fills their bounding box, one for each body.",
    ),
    ("Is(leg) => Each(Merge)", "Each connected group of leg hulls is merged into one convex hull."),
    ("All => Merge", "All hulls are merged into one convex hull, one for each body."),
    (
        "Diff(Is(drawer), Geo(Is(drawer), -Z)) => Delete",
        "The drawer hulls, except those that reach farthest along -Z, are deleted.",
    ),
    (
        "Intersect(All, Attach(All, Is(arm))) => Delete",
        "All hulls, but only those that touch an arm hull, are deleted.",
    ),
    (
        'Attach(Is(handle), Is(drawer)) => Each(Replace("bar.obj", longest)) as bar',
        "Each connected group of handle hulls that touch a drawer hull is replaced by “bar.obj”, turned lengthwise and"
        " stretched to fill its bounding box; what is made is labelled bar.",
    ),
    (
        "Attach(Is(leg), Is(leg)) => Each(Replace(capsule, tight))",
        "Each connected group of leg hulls that touch another leg hull is replaced by the smallest capsule around it,"
        " at any angle.",
    ),
    (
        "Is(leg) => Each(Replace(cylinder, native))",
        "Each connected group of leg hulls is replaced by the smallest cylinder around it along X, Y or Z.",
    ),
    ("Is(leg) => Each(Replace(cylinder, native, Z))", "replaced by the thinnest cylinder around it, along Z."),
    ("Is(leg) => Each(Replace(capsule, X))", "replaced by a capsule that fills its bounding box, along X."),
    ("Is(leg) => Each(Replace(box, inscribed))", "replaced by the largest box inside its convex hull."),
    ("Is(leg) => Each(Replace(capsule, volume))", "replaced by a capsule of its volume."),
    (
        "Is(leg) => Each(Replace(sphere, radius = 0.05))",
        "replaced by a sphere of radius 0.05 m at the middle of its bounding box.",
    ),
    ("Is(leg) => Each(Replace(sphere, longest))", "a sphere as wide as the longest side of its bounding box."),
    ("Is(leg) => Shrink(0.002)", "The leg hulls are made smaller all round by 0.002 m."),
    (
        "Is(leg) => Replace(sphere, native)",
        "The leg hulls are replaced by the smallest sphere around them, one for each body.",
    ),
    (
        'Diff(Union(Is("back rest"), Is(leg)), Attach(Is(leg), All)) => Scale(all, 1.5)',
        "(the “back rest” hulls and the leg hulls), except the leg hulls that touch any other hull, are scaled by 1.5"
        " in every direction, about their common centre.",
    ),
    ("Geo(All, +X) => Each(Scale(Z, 2))", "scaled by 2 along Z, about its common centre."),
    (
        'All => Add(+X, "knob.obj")',
        "All hulls are given “knob.obj” at their +X side, as large as fits, one for each body.",
    ),
    ('All => Each(Add(+X, "knob.obj", keep))', "is given “knob.obj” at its +X side, in its own size."),
]


@pytest.mark.parametrize(("text", "sentence"), _SENTENCES)
def test_a_rule_reads_as_a_sentence(text: str, sentence: str) -> None:
    (rule,) = Program.parse(text).rules
    assert explain(rule).endswith(sentence)


def test_an_orientation_says_what_will_point_where() -> None:
    text = explain(parse_orient("orient +Z: Is(leg) -> Is(top), +X: All -> Is(door)"))
    assert text == (
        "For reasoning, turn every asset so that +Z points from the leg hulls to the top hulls"
        " and +X points from all hulls to the door hulls."
    )
    assert "quarter turns" in explain(parse_orient("orient snap +Z: Is(leg) -> Is(top)"))


def test_an_extractor_reads_as_a_phrase() -> None:
    assert explain(parse_extractor("Union(Is(a), Is(b))")) == "the a hulls and the b hulls"
