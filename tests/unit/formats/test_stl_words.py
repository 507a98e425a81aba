"""ASCII STL: facets are found whatever the titles of solids say; other layouts are in tests/corpus/stl."""

import pytest

from meshforge.formats.meshfile.stl import parse_stl

FACET = """  facet normal 0 0 1
    outer loop
      vertex {} 0 0
      vertex 1 0 -2.5e-3
      vertex 0 1 0
    endloop
  endfacet
"""
TWO = FACET.format(0) + FACET.format(7)

TEXTS = {
    "on few lines": f"solid a\n{' '.join(TWO.split())}\nendsolid a\n",
    "a name that runs on": f"solid_of_many\n{TWO}endsolid\n",
    "facets in titles": "".join(
        f"solid {name}\n{FACET.format(0)}endsolid {name}\n"
        for name in ("facet", "a", "my facet x", "endfacet", "Facet normal 0 0 1", "solid facet", "facet endfacet")
    ),
    "a facet behind the title": f"solid a {' '.join(FACET.format(0).split())}\n{FACET.format(7)}endsolid a\n",
}


@pytest.mark.parametrize("name", TEXTS)
def test_facets_are_read_whatever_stands_around_them(name: str) -> None:
    text = TEXTS[name]
    found = parse_stl(text.encode(), "a.stl")
    assert len(found.corners) == text.lower().count("outer")
    assert {tuple(row) for row in found.corners[:, 1:].reshape(-1, 6).tolist()} <= {(1, 0, -2.5e-3, 0, 1, 0)}
    assert set(found.corners[:, 0, 0].tolist()) <= {0, 7}
