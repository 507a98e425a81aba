"""ASCII STL: facets are found whatever the titles of solids say, and however the text is laid out."""

from __future__ import annotations

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
    "one solid": f"solid a part\n{TWO}endsolid a part\n",
    "without a name": f"solid\n{TWO}endsolid",
    "capitals": f"solid A Part\n{TWO}endsolid\n".replace("vertex", "VERTEX").replace("facet", "Facet"),
    "windows": f"solid a\n{TWO}endsolid a\n".replace("\n", "\r\n"),
    "on few lines": f"solid a\n{' '.join(TWO.split())}\nendsolid a\n",
    "no facet": "solid a\nendsolid a\n",
    "two solids": f"solid a\n{FACET.format(0)}endsolid a\nsolid b\n{FACET.format(7)}endsolid b\n",
    "no end": f"solid a\n{TWO}",
    "words between": f"solid a\n{TWO.replace('outer loop', 'outer loop with color 3')}endsolid a\n",
    "a name that runs on": f"solid_of_many\n{TWO}endsolid\n",
    "a facet in the title": f"solid facet normal 0 0 1\n{TWO}endsolid\n",
    "facets in titles": "".join(
        f"solid {name}\n{FACET.format(0)}endsolid {name}\n"
        for name in ("facet", "a", "my facet x", "endfacet", "Facet normal 0 0 1", "solid facet", "facet endfacet")
    ),
    "one line": f"solid a part {' '.join(TWO.split())} endsolid a part\n",
    "a facet behind the title": f"solid a {' '.join(FACET.format(0).split())}\n{FACET.format(7)}endsolid a\n",
}


@pytest.mark.parametrize("name", TEXTS)
def test_facets_are_read_whatever_stands_around_them(name: str) -> None:
    text = TEXTS[name]
    found = parse_stl(text.encode(), "a.stl")
    assert len(found.corners) == text.lower().count("outer")
    assert {tuple(row) for row in found.corners[:, 1:].reshape(-1, 6).tolist()} <= {(1, 0, -2.5e-3, 0, 1, 0)}
    assert set(found.corners[:, 0, 0].tolist()) <= {0, 7}
