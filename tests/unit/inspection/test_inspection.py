"""The Python side of the commands that look at one asset: it takes meshes and paths alike."""

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image

import meshforge as mf
from meshforge.checks import OF_EDIT, Clearance
from tests.unit.batch.families import write_urdf_table
from tests.unit.rendering.scenes import box, edited, hull, table


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return write_urdf_table(tmp_path / "in")


def read_pixels(path: Path) -> npt.NDArray[np.uint8]:
    with Image.open(path) as image:
        return np.asarray(image)


def test_check_says_what_is_beyond_an_engine(path: Path) -> None:
    assert str(mf.check(path)) == "legal" and not mf.check(path).has_failed
    assert mf.check(mf.load(path), "unity").findings == mf.check(str(path), "unity").findings
    assert str(mf.check(path, "unity")) == "legal (by the limits of Unity, which was not asked itself)"
    with pytest.raises(mf.MeshForgeError, match="untiy"):
        mf.check(path, "untiy")


def test_an_engine_that_is_here_is_asked_itself(path: Path) -> None:
    asked = mf.check(path, "mujoco").loaded
    assert asked and asked.given == "file" and asked.refusal is None
    edited = mf.Program.parse("Is(leg) => Merge").run(mf.load(path), {}).mesh
    asked = mf.check(edited, "mujoco").loaded  # what no file is of yet is written for it
    assert asked and asked.given == "conversion" and asked.refusal is None
    path.write_text(path.read_text().replace("</robot>", '<joint name="j" type="fixed"/></robot>'))
    with pytest.raises(mf.MeshForgeError, match="table"):
        mf.check(path, "mujoco")


def test_a_check_of_no_plugin_is_refused(path: Path) -> None:
    with pytest.raises(mf.MeshForgeError, match="there is no check 'absent'"):
        mf.check(path, checks=["absent"])


def test_check_prints_each_finding_with_its_remedy() -> None:
    flat = hull("flat", box((0, 0, 0), (1, 1, 1e-9)))
    found = mf.check(mf.SymbolicMesh((flat,)))
    assert found.has_failed
    first = found.findings[0]
    assert str(found).startswith(f"error {first.code}: {first.message}\n  {first.remedy}")


def test_check_against_the_asset_before_measures_what_the_edit_closed(path: Path) -> None:
    mesh = mf.load(path)
    program = mf.Program.parse("Is(leg) => Merge")
    found = mf.check(program.run(mesh, {}).mesh, clearance=True, against=path, cell=0.1)
    changed = found.get(OF_EDIT, Clearance)
    assert changed is not None and changed.closed > 100  # the space between the legs, in litres
    assert "clearance" in str(found)


def test_diff_names_the_hulls_that_went_and_came(tmp_path: Path) -> None:
    found = mf.diff(table(), edited(), tmp_path / "diff.png")
    assert (found.removed, found.made, found.changed) == (("left", "right"), ("right~1",), ())
    assert found.kept == ("leg0", "leg1", "knob") and not found.is_empty
    assert str(found).splitlines()[0] == "hulls     5 -> 4" and "+ right~1" in str(found)
    assert read_pixels(tmp_path / "diff.png").shape[1] > 1000
    assert mf.diff(table(), table()).is_empty


def test_a_hull_of_another_shape_has_changed(path: Path) -> None:
    wide = mf.Program.parse("Is(top) => Scale(X, 2)").run(mf.load(path), {}).mesh
    moved = wide.with_hulls(
        mf.Hull("body/top", h.body, h.shape, h.annotation) if h.label == "top" else h for h in wide.hulls
    )
    assert mf.diff(path, moved).changed == ("body/top",)


def test_render_takes_paths_and_meshes_and_writes_the_same_picture(path: Path, tmp_path: Path) -> None:
    image = mf.render(path, tmp_path / "table.png", size=(200, 150))
    assert image.size == (200, 150)
    again = mf.render(mf.load(path), color_by="label", size=(200, 150))
    assert np.array_equal(np.asarray(image), read_pixels(tmp_path / "table.png"))
    assert np.array_equal(np.asarray(image), np.asarray(again))
    other = mf.render(path, views=["front", "top"], size=(200, 150), highlight={"body/top"})
    assert not np.array_equal(np.asarray(image), np.asarray(other))
    with pytest.raises(mf.MeshForgeError, match="sideways"):
        mf.render(path, views=["sideways"])  # type: ignore[list-item]


def test_convert_writes_another_format_with_the_labels_beside_it(path: Path, tmp_path: Path) -> None:
    saved = mf.convert(path, tmp_path / "out/table.xml")
    assert any("read back" in note or "MuJoCo" in note for note in saved.notes)
    assert mf.load(saved.path).labels.keys() and {h.label for h in mf.load(saved.path).hulls} == {"top", "leg", "misc"}
    again = mf.convert(mf.load(path), tmp_path / "out/table.xml")
    assert "is there already and was left as it is" in again.notes[-1]
    with pytest.raises(mf.MeshForgeError, match="cannot be named for Unreal"):
        mf.convert(path, tmp_path / "out/table.usda", names="unreal")


def test_decompose_makes_a_mesh_of_hulls(tmp_path: Path) -> None:
    path = tmp_path / "bar.obj"
    mf.save(mf.SymbolicMesh((hull("bar", box((0, 0, 0), (2, 1, 1))),)), path)
    made = mf.decompose(path, mf.VhacdSettings(resolution=5000, max_convex_hulls=2), cache=False)
    assert made.hulls[0].name == "hull_0" and sum(h.volume for h in made.hulls) == pytest.approx(2, rel=0.1)
    mf.save(made, tmp_path / "bar.urdf")
    assert len(mf.load(tmp_path / "bar.urdf").hulls) == len(made.hulls)
    with pytest.raises(mf.MeshForgeError, match=r"absent\.obj"):
        mf.decompose(tmp_path / "absent.obj")
