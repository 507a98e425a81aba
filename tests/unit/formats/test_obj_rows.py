"""OBJ numbers read all at once are those read statement by statement."""

from __future__ import annotations

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats.meshfile import obj
from meshforge.formats.meshfile.obj import ObjText, parse_obj

CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1e-3 2.5E2 -7\n"

PLAIN = {
    "triangles": CORNERS + "f 1 2 3\nf 1 3 4\n",
    "blanks and tabs": "v\t0 0 0 \r\n v 1\t0 0\r\nv 0 1 0\r\n\r\n  f 1 2  3\r\n",
    "old line ends": "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
    "texture and normals": CORNERS + "f 1/1/1 2/2/1 3/3/1\nf 1//1 3//1 4//1\nf 1/2 3/3 4/1\n",
    "polygons": CORNERS + "f 1 2 3 4\nf 1 2 3\nf 5 4 3 2 1\nf 2 3\n",
    "quads": CORNERS + "f 1 2 3 4\nf 5 4 3 2\n",
    "colours": "v 0 0 0 1 1 1\nv 1 0 0 1 0 1\nv 0 1 0 .5 0 1\nf 1 2 3\n",
    "numbers from the end": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 2 2 2\nf -4 -1 2\nf 1 2 4\n",
    "groups": "g a\n" + CORNERS + "f 1 2 3\no b\nf 1 2 4\ng c d\nf 1 2 5\ng a\nf 2 3 4\no b\nf 2 3 5\n",
    "no end": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
}
UNUSUAL = {
    "comments": "v 0 0 0 # low\nv 1 0 0\nv 0 1 0\nf 1 2 3 # one\n",
    "continued": "v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n",
    "weights": "v 0 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "old faces": CORNERS + "fo 1 2 3\nf 1 2 4\n",
    "far from any number": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf +1 2 3\nv inf nan 0\n",
}
DAMAGED = {
    "short vertex": "v 0 0 0\nv 1 0\nv 0 1 0 4\nf 1 2 3\n",
    "word": "v 0 0 0\nv 1 0 zero\nv 0 1 0\nf 1 2 3\n",
    "a vertex in a vertex": "v 0 0 0 v 1\nv 1 0 0\nv v 0 1\nf 1 2 3\n",
    "separator": "v 0 0 1_0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "vertex zero": CORNERS + "f 0 1 2\n",
    "beyond": CORNERS + "f 1 2 3\nf 1 2 6\n",
    "before the first": "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n",
    "no vertex number": CORNERS + "f /1 2 3 4\n",
    "half a number": CORNERS + "f 1.5 2 3\n",
    "huge number": CORNERS + "f 1 2 99999999999999999999999\n",
    "short face behind": CORNERS + "f 1 2 3\nf 1 2 9\nf 1\n",
}


def read(text: str) -> ObjText:
    return parse_obj(text.encode(), "a.obj")


def carefully(text: str, monkeypatch: pytest.MonkeyPatch) -> ObjText:
    """The file read statement by statement."""
    with monkeypatch.context() as patch:
        patch.setattr(obj, "plain_vertices", lambda *_: None)
        patch.setattr(obj, "plain_faces", lambda *_: None)
        return read(text)


@pytest.mark.parametrize("name", [*PLAIN, *UNUSUAL])
def test_rows_read_at_once_are_those_read_one_by_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = {**PLAIN, **UNUSUAL}[name]
    quick, careful = read(text), carefully(text, monkeypatch)
    assert quick.statements == careful.statements
    assert quick.groups == careful.groups
    assert quick.vertices.dtype == np.float64
    for field in ("vertices", "vertex_at", "faces", "face_at", "face_group"):
        assert np.array_equal(getattr(quick, field), getattr(careful, field), equal_nan=True), field
        assert getattr(quick, field).shape == getattr(careful, field).shape, field


@pytest.mark.parametrize("name", PLAIN)
def test_plain_rows_are_read_at_once(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(obj, "arguments", None)  # the careful way cannot do without it
    assert len(read(PLAIN[name]).faces) > 0


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_rows_are_told_as_when_read_one_by_one(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssetError) as careful:
        carefully(DAMAGED[name], monkeypatch)
    with pytest.raises(AssetError) as quick:
        read(DAMAGED[name])
    assert str(quick.value) == str(careful.value)
    assert "a.obj:" in str(quick.value)
