"""Extractors combined by Python's operators, and printed."""

import pytest
from hypothesis import given

import meshforge as mf
from meshforge.language import Extractor, parse_extractor, show
from tests.examples import examples
from tests.strategies import extractors
from tests.unit.language.scenes import table


def test_operators_are_the_set_operators_of_the_language() -> None:
    legs, ends = mf.Is("leg"), mf.Geo(mf.All(), "-Z")
    assert legs & ends == mf.Intersect(legs, ends)
    assert legs | ends == mf.Union(legs, ends)
    assert legs - ends == mf.Diff(legs, ends)
    mesh = table()
    assert (legs - ends).select(mesh) == legs.select(mesh) - ends.select(mesh)
    assert (legs & ends).select(mesh) == legs.select(mesh) & ends.select(mesh)
    assert (legs | ends).select(mesh) == legs.select(mesh) | ends.select(mesh)


def test_a_combination_prints_as_program_text() -> None:
    handles = mf.Attach(mf.Is("handle"), mf.Is("drawer"))
    assert str(handles - mf.Is("Merge") | mf.All()) == 'Union(Diff(Attach(Is(handle), Is(drawer)), Is("Merge")), All)'
    rule = mf.Rule(mf.Is("leg") & mf.Geo(mf.Is("leg"), "-Z"), mf.Delete())
    assert str(mf.Program(rules=(rule,))) == "labels leg\n\nIntersect(Is(leg), Geo(Is(leg), -Z)) => Delete\n"


@given(extractors())
@examples(50)
def test_the_text_of_an_extractor_reads_back_as_it(node: Extractor) -> None:
    assert str(node) == show(node)
    assert parse_extractor(str(node)) == node


def test_what_is_no_extractor_is_refused_with_the_remedy() -> None:
    with pytest.raises(mf.MeshForgeError, match=r"Write All\(\)"):
        mf.Is("leg") & mf.All  # type: ignore[operator]
    with pytest.raises(mf.MeshForgeError, match="takes extractors, not 'panel'"):
        mf.Is("leg") | "panel"  # type: ignore[operator]
