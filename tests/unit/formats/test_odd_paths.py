"""Files that are no plain files: pipes, devices, loops, folders, names of all kinds; and XML without measure."""

import os
from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read, save
from tests.corpus_case import run_main
from tests.mesh_files import obj
from tests.soups import box

CUBE = obj(box())
ROBOT = (
    '<robot name="r"><link name="l"><collision><geometry><mesh filename="{}"/></geometry></collision></link></robot>'
)


def robot(folder: Path, reference: str) -> Path:
    path = folder / "robot.urdf"
    path.write_text(ROBOT.format(reference), encoding="utf-8")
    return path


@pytest.mark.parametrize("suffix", [".obj", ".stl", ".urdf", ".xml", ".sdf", ".glb", ""])
def test_a_pipe_is_refused_at_once(suffix: str, tmp_path: Path) -> None:
    pipe = tmp_path / f"pipe{suffix}"
    os.mkfifo(pipe)
    with pytest.raises(AssetError, match="pipe"):
        read(pipe)


def test_a_pipe_among_the_files_of_an_asset_is_not_waited_for(tmp_path: Path) -> None:
    for name in ("mesh.obj", "materials.mtl", "none.xml"):
        os.mkfifo(tmp_path / name)
    (tmp_path / "cube.obj").write_bytes(b"mtllib materials.mtl\n" + CUBE)
    (tmp_path / "part.xml").write_text("<mujocoinclude/>\n", encoding="utf-8")
    assert len(read(tmp_path / "cube.obj").geoms) == 1
    assert len(read(tmp_path).geoms) == 1
    with pytest.raises(AssetError, match="is not there"):
        read(robot(tmp_path, "mesh.obj"))
    with pytest.raises(AssetError, match="part of a model"):
        read(tmp_path / "part.xml")


@pytest.mark.parametrize("device", ["/dev/null", "/dev/zero", "/dev/full"])
def test_a_device_is_refused(device: str, tmp_path: Path) -> None:
    link = tmp_path / "device.obj"
    link.symlink_to(device)
    with pytest.raises(AssetError, match="pipe or a device"):
        read(link)


def test_a_loop_of_links_is_no_file(tmp_path: Path) -> None:
    one, two = tmp_path / "one.obj", tmp_path / "two.obj"
    one.symlink_to(two)
    two.symlink_to(one)
    with pytest.raises(AssetError, match="there is no such file"):
        read(one)
    with pytest.raises(AssetError, match="is not there") as error:
        read(robot(tmp_path, "one.obj"))
    assert "a link that leads nowhere" in error.value.message


def test_a_folder_with_the_suffix_of_a_file_says_that_it_is_a_folder(tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").mkdir()
    with pytest.raises(AssetError, match="no mesh file in this folder"):
        read(tmp_path / "robot.urdf")


def test_links_to_files_and_folders_are_followed(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "cube.obj").write_bytes(CUBE)
    (tmp_path / "link").symlink_to("real")
    (tmp_path / "cube.obj").symlink_to("link/cube.obj")
    assert [geom.name for geom in read(tmp_path / "cube.obj").geoms] == ["geom0"]
    assert [geom.name for geom in read(tmp_path / "link").geoms] == ["cube"]
    assert len(read(robot(tmp_path, "link/cube.obj")).geoms) == 1


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read every file")
def test_a_file_that_may_not_be_read_says_so(tmp_path: Path) -> None:
    path = tmp_path / "cube.obj"
    path.write_bytes(CUBE)
    path.chmod(0)
    with pytest.raises(AssetError, match="Permission denied"):
        read(path)


@pytest.mark.parametrize(
    "name", ["a\nb.obj", "a\x1b[31mb.obj", "blank name.obj", "-x.obj", "*.obj", "ü ñ 机.obj", "a'\"b.obj"]
)
def test_a_name_of_any_letters_is_read_and_written(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / name
    path.write_bytes(CUBE)
    asset = read(path)
    assert save(asset, tmp_path / "out" / name).path.read_bytes() == CUBE
    monkeypatch.chdir(tmp_path)
    assert run_main(["info", f"./{name}"]).code == 0


def test_a_name_that_is_no_text_is_refused_and_shown(tmp_path: Path) -> None:
    name = os.fsdecode(b"t\xfcr.obj")
    folder = tmp_path / "parts"
    folder.mkdir()
    try:
        (folder / name).write_bytes(CUBE)
    except OSError:
        pytest.skip("this disk has names in UTF-8 only")
    with pytest.raises(AssetError, match=r"t\\xfcr\.obj: this name is not UTF-8"):
        read(folder)
    assert "t\\xfcr.obj: this name is not UTF-8" in run_main(["info", str(folder)]).err
    assert "\\xff.obj: there is no such file" in run_main(["info", os.fsdecode(b"\xff.obj")]).err


def test_a_path_too_long_for_the_system_is_refused(tmp_path: Path) -> None:
    refused = run_main(["info", str(tmp_path / ("x" * 5000 + ".obj"))])
    assert refused.code == 2
    assert "fault" not in refused.err


@pytest.mark.parametrize("reference", ["../.profile", "../../keys", "../mesh.sh"])
def test_a_reference_puts_no_file_outside_of_the_output_that_is_not_of_an_asset(reference: str, tmp_path: Path) -> None:
    source, out = tmp_path / "a" / "b" / "in", tmp_path / "c" / "d" / "out"
    source.mkdir(parents=True)
    source.joinpath(reference).write_text("odd", encoding="utf-8")
    shown = ROBOT.format("cube.obj").replace(
        "</link>", f'<visual><geometry><mesh filename="{reference}"/></geometry></visual></link>'
    )
    (source / "cube.obj").write_bytes(CUBE)
    (source / "robot.urdf").write_text(shown, encoding="utf-8")
    asset = read(source / "robot.urdf")
    with pytest.raises(AssetError, match="outside of the output folder"):
        save(asset, out / "robot.urdf", overwrite=True)
    assert not out.joinpath(reference).exists()


@pytest.mark.slow
def test_a_hundred_thousand_attributes_and_elements_are_read(tmp_path: Path) -> None:
    many = " ".join(f'a{k}="{k}"' for k in range(100_000))
    path = tmp_path / "wide.urdf"
    path.write_text(f'<robot name="r" {many}><link name="l"/>{"<gazebo/>" * 100_000}</robot>', encoding="utf-8")
    assert read(path).geoms == ()


@pytest.mark.slow
def test_a_hundred_thousand_nested_elements_are_read(tmp_path: Path) -> None:
    path = tmp_path / "deep.urdf"
    path.write_text(f'<robot name="r"><link name="l"/>{"<x>" * 100_000}{"</x>" * 100_000}</robot>', encoding="utf-8")
    assert read(path).geoms == ()
