"""What a mesh is in a prompt and in a notebook: one line, and a picture beside a table."""

import base64
import io
import pickle
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

from PIL import Image

import meshforge as mf
from tests.unit.batch.families import write_urdf_table
from tests.unit.rendering.scenes import box, hull, table


class Cells(HTMLParser):
    """The texts of the cells of a table, and the tags that are open at the end."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.cells: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "td":
            self.cells.append("")
        if tag != "img":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "td":
            self.cells[-1] += data


def test_a_mesh_is_one_line(tmp_path: Path) -> None:
    mesh = mf.load(write_urdf_table(tmp_path))
    assert repr(mesh) == "<SymbolicMesh table.urdf: 4 hulls, 1 body: 2 leg, 1 misc, 1 top>"
    assert repr(table()) == "<SymbolicMesh in memory: 5 hulls, 1 body: 2 leg, 2 panel, 1 without label>"
    assert repr(mf.SymbolicMesh(())) == "<SymbolicMesh in memory: 0 hulls, 0 bodies: empty>"
    assert repr(mesh.hulls[0]) == "<Hull 'body/top': box, body body, label top>"
    assert repr(mesh.hulls[3]) == "<Hull 'body/crumb': 8 vertices, body body, label misc>"


def test_a_notebook_shows_a_picture_and_a_row_for_each_hull() -> None:
    html = table()._repr_html_()
    found = Cells()
    found.feed(html)
    assert found.open == []
    assert found.cells[1:7] == ["left", "panel", "body", "box", "0.6 × 0.8 × 0.04", "0.0192"]
    assert found.cells[1::7] == ["left", "right", "leg0", "leg1", "knob"]
    png = base64.b64decode(html.split("base64,")[1].split("'")[0])
    with Image.open(io.BytesIO(png)) as image:
        assert image.size == (480, 380)
    assert html == table()._repr_html_()


def test_names_and_labels_are_text_in_the_page() -> None:
    html = mf.SymbolicMesh((hull("<script>'\"", box((0, 0, 0), (1, 1, 1)), "<b>"),))._repr_html_()
    assert "<script>" not in html and "<b>" not in html.replace("<b>in memory</b>", "")


def test_of_very_many_hulls_the_table_shows_the_first() -> None:
    many = mf.SymbolicMesh(tuple(hull(f"h{k}", box((k, 0, 0), (1, 1, 1))) for k in range(502)))
    html = many._repr_html_()
    assert len(re.findall("<tr>", html)) == 501 and "and 2 hulls more" in html
    assert "0 hulls" in mf.SymbolicMesh(())._repr_html_()


def test_the_methods_are_found_in_a_process_that_only_unpickled_a_mesh(tmp_path: Path) -> None:
    (tmp_path / "mesh.pickle").write_bytes(pickle.dumps(table()))
    code = (
        "import pickle, sys; mesh = pickle.load(open(sys.argv[1], 'rb')); import meshforge.symbolic.mesh as own;"
        "print(len(mesh._repr_html_()) > 1000, callable(own._find_above('inspection.display', 'show')))"
    )
    words = [sys.executable, "-c", code, str(tmp_path / "mesh.pickle")]
    assert subprocess.run(words, capture_output=True, text=True, check=True).stdout == "True True\n"
