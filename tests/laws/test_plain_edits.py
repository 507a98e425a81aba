"""Laws of edits of plain mesh files: what is kept keeps its name and place, what is deleted is gone."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from meshforge.formats import read, save
from meshforge.geometry import convex_hull
from meshforge.symbolic import Asset, Geom
from tests.examples import examples
from tests.mesh_files import ply, stl_ascii, stl_binary
from tests.soups import Soup, box, together

WRITERS: dict[str, Callable[[Soup], bytes]] = {".stl": stl_binary, ".STL": stl_ascii, ".ply": ply}
GROUP_LINES = st.sampled_from(["", "o a", "o b", "g a", "g x", "o a\ng x", "o a#0", "o", "usemtl oak", "# note", "s 1"])


@st.composite
def obj_texts(draw: st.DrawFn) -> str:
    """OBJ files of one to five boxes in any order of faces, with group lines anywhere."""
    count = draw(st.integers(1, 5))
    soup = together(*(box((3 * k, 0, 0), (1 + k, 1, 1)) for k in range(count)))
    faces = soup[1].tolist()
    if draw(st.booleans()):
        faces = draw(st.permutations(faces))
    lines = [f"v {x:g} {y:g} {z:g}" for x, y, z in soup[0].tolist()]
    for face in faces:
        if not draw(st.integers(0, 9)):
            lines.append(draw(GROUP_LINES))
        numbers = [c + 1 if draw(st.booleans()) else c - len(soup[0]) for c in face]
        lines.append("f " + " ".join(map(str, numbers)))
    return "\n".join(lines) + draw(st.sampled_from(["", "\n"]))


def edit(draw: Callable[..., Any], asset: Asset) -> Asset:
    kept = [g for g in asset.geoms if draw(st.booleans())]
    made = [
        Geom(f"{asset.geoms[0].name}~{k}", "body", convex_hull(box((3 * k, 5, 0))[0]), asset.geoms[0].name)
        for k in range(1, 1 + draw(st.integers(0 if kept or asset.non_convex else 1, 2)))
    ]
    return asset.with_geoms([*kept, *made])


def summary(asset: Asset, names: dict[str, str]) -> dict[str, list[float]]:
    return {names.get(g.name, g.name): [g.shape.volume, *g.shape.aabb.min, *g.shape.aabb.max] for g in asset.geoms}


@examples(120)
@given(text=obj_texts(), data=st.data())
def test_an_edited_obj_reads_back_as_the_edit_under_the_same_names(text: str, data: st.DataObject) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "a.obj"
        path.write_text(text)
        asset = read(path)
        if not asset.geoms:
            return
        wanted = edit(data.draw, asset)
        saved = save(wanted, Path(folder) / "b.obj")
        back = read(saved.path)
        assert saved.names == {}
        assert summary(back, {}) == summary(wanted, {})
        assert sorted(o.name for o in back.non_convex) == sorted(o.name for o in asset.non_convex)
        again = save(back, Path(folder) / "c.obj")
        assert again.path.read_bytes() == saved.path.read_bytes()


@examples(60)
@given(kind=st.sampled_from(sorted(WRITERS)), count=st.integers(1, 4), data=st.data())
def test_an_edited_file_without_names_says_how_hulls_are_called(kind: str, count: int, data: st.DataObject) -> None:
    soup = together(*(box((3 * k, 0, 0), (1 + k, 1, 1)) for k in range(count)))
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"a{kind}"
        path.write_bytes(WRITERS[kind]((soup[0], np.asarray(data.draw(st.permutations(soup[1].tolist()))))))
        wanted = edit(data.draw, read(path))
        saved = save(wanted, Path(folder) / f"b{kind}")
        assert summary(read(saved.path), {}) == summary(wanted, dict(saved.names))
