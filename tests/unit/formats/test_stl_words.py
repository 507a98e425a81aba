"""ASCII STL read all at once is what it is read facet by facet."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.meshfile import stl
from meshforge.formats.meshfile.stl import StlText, facet_spans, parse_stl

FACET = """  facet normal 0 0 1
    outer loop
      vertex {} 0 0
      vertex 1 0 -2.5e-3
      vertex 0 1 0
    endloop
  endfacet
"""
TWO = FACET.format(0) + FACET.format(7)

PLAIN = {
    "one solid": f"solid a part\n{TWO}endsolid a part\n",
    "without a name": f"solid\n{TWO}endsolid",
    "capitals": f"solid A Part\n{TWO}endsolid\n".replace("vertex", "VERTEX").replace("facet", "Facet"),
    "windows": f"solid a\n{TWO}endsolid a\n".replace("\n", "\r\n"),
    "on few lines": f"solid a\n{' '.join(TWO.split())}\nendsolid a\n",
    "no facet": "solid a\nendsolid a\n",
}
UNUSUAL = {
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
DAMAGED = {
    "word": f"solid a\n{TWO.replace('7', 'seven')}endsolid a\n",
    "separator": f"solid a\n{TWO.replace('7', '7_0')}endsolid a\n",
    "two corners": f"solid a\n{TWO.replace('vertex 7 0 0', '')}endsolid a\n",
    "cut short on one line": f"solid a {' '.join(TWO[:-20].split())} endsolid a\n",
    "cut short": f"solid a\n{TWO[:-20]}\nendsolid a\n",
}


def carefully(text: str, monkeypatch: pytest.MonkeyPatch) -> StlText:
    with monkeypatch.context() as patch:
        patch.setattr(stl, "_plain_ascii", lambda _: None)
        return parse_stl(text.encode(), "a.stl")


@pytest.mark.parametrize("name", [*PLAIN, *UNUSUAL])
def test_facets_read_at_once_are_those_read_one_by_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = {**PLAIN, **UNUSUAL}[name]
    quick, careful = parse_stl(text.encode(), "a.stl"), carefully(text, monkeypatch)
    assert np.array_equal(quick.corners, careful.corners)
    assert quick.corners.shape == careful.corners.shape
    assert np.array_equal(quick.solid, careful.solid)
    assert quick.solids == careful.solids
    spans = facet_spans(text.encode()).tolist()
    assert len(spans) == len(quick.corners)
    assert all(text[start:stop].lower().split()[:6] == FACET.lower().split()[:6] for start, stop in spans)


@pytest.mark.parametrize("name", PLAIN)
def test_plain_facets_are_read_at_once(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stl, "_any_ascii", None)
    assert len(parse_stl(PLAIN[name].encode(), "a.stl").corners) == (0 if name == "no facet" else 2)


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_facets_are_told_as_when_read_one_by_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssetError) as careful:
        carefully(DAMAGED[name], monkeypatch)
    with pytest.raises(AssetError) as quick:
        parse_stl(DAMAGED[name].encode(), "a.stl")
    assert str(quick.value) == str(careful.value)
