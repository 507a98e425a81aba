import asyncio
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import TypeVar

import pytest

from meshforge.common import ProjectError, UsageError
from meshforge.studio import transfers
from meshforge.studio.transfers import TooLargeError, Uploads, confine_path, find_assets
from meshforge.studio.workers import Workers

Result = TypeVar("Result")


class InProcess(Workers):
    def run(self, function: Callable[..., Result], *args: object) -> Result:  # type: ignore[override]
        return function(*args)


async def chunks(*parts: bytes) -> AsyncIterator[bytes]:
    for part in parts:
        yield part


@pytest.mark.parametrize(
    "path",
    [
        "/etc/passwd", "..", "../x.obj", "a/../../x.obj", "a//b.obj", "a/./b.obj", ".hidden/x.obj", "a/", "",
        "a\\b.obj", "C:x.obj", "a\nb.obj", "a\0b.obj", "x" * 300,
    ],
)  # fmt: skip
def test_paths_with_tricks_are_refused(path: str) -> None:
    with pytest.raises(UsageError):
        confine_path(path)


@pytest.mark.parametrize("path", ["x.obj", "robot/meshes/Arm 1.stl", "möbel/tür.obj"])
def test_plain_paths_are_taken(path: str) -> None:
    assert confine_path(path).as_posix() == path


def test_a_file_that_is_too_large_is_named_and_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transfers, "MOST_ONE_FILE", 5)
    home = Uploads(tmp_path / "uploads")
    with pytest.raises(TooLargeError) as refused:
        asyncio.run(home.put("robot/arm.stl", chunks(b"123", b"456")))
    assert refused.value.where == "robot/arm.stl" and home.list_files()[1] == ()
    asyncio.run(home.put("robot/arm.stl", chunks(b"123", b"45")))
    assert (home.list_files()[0] / "robot/arm.stl").read_bytes() == b"12345"


def test_files_too_large_together_are_no_fault_of_the_last_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(transfers, "MOST_ALL_FILES", 3 * transfers.MB)
    home = Uploads(tmp_path / "uploads")
    asyncio.run(home.put("a.stl", chunks(bytes(2 * transfers.MB))))
    with pytest.raises(TooLargeError, match="larger than 3 MB together"):
        asyncio.run(home.put("b.stl", chunks(bytes(2 * transfers.MB))))


def test_a_file_in_the_place_of_a_folder_is_one_message(tmp_path: Path) -> None:
    home = Uploads(tmp_path / "uploads")
    asyncio.run(home.put("a", chunks(b"1")))
    with pytest.raises(UsageError, match="same name"):
        asyncio.run(home.put("a/b", chunks(b"1")))
    assert home.list_files()[1] == ("a",)


def test_what_was_sent_to_an_earlier_studio_is_gone(tmp_path: Path) -> None:
    asyncio.run(Uploads(tmp_path / "uploads").put("a", chunks(b"1")))
    assert Uploads(tmp_path / "uploads").list_files()[1] == ()


_BODY = "<worldbody><body><geom size='1'/></body></worldbody>"
_MESH_GEOM = "<worldbody><body><geom type='mesh' mesh='m'/></body></worldbody>"
_MESH_LINK = "<link name='a'><collision name='c'><geometry>{}</geometry></collision></link>"
_URDF_MESH, _SDF_MESH = "<mesh filename='OUT'/>", "<mesh><uri>OUT</uri></mesh>"
REFERRING = {
    "include.xml": f"<mujoco>{_BODY}<include file='OUT'/></mujoco>",
    "mesh.xml": f"<mujoco><asset><mesh name='m' file='OUT'/></asset>{_MESH_GEOM}</mujoco>",
    "meshdir.xml": f"<mujoco><compiler meshdir='..'/><asset><mesh name='m' file='../UP'/></asset>{_MESH_GEOM}</mujoco>",
    "texture.xml": f"<mujoco><asset><texture type='2d' name='t' file='OUT'/></asset>{_BODY}</mujoco>",
    "mesh.urdf": f"<robot name='r'>{_MESH_LINK.format(_URDF_MESH)}</robot>",
    "mesh.sdf": f"<sdf version='1.7'><model name='r'>{_MESH_LINK.format(_SDF_MESH)}</model></sdf>",
    "layer.usda": "#usda 1.0\n(subLayers=[@OUT@])\n",
    "buffer.gltf": '{"asset":{"version":"2.0"},"buffers":[{"uri":"OUT","byteLength":36}],'
    '"bufferViews":[{"buffer":0,"byteLength":36}],'
    '"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],'
    '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}',
}


@pytest.mark.parametrize("name", REFERRING)
@pytest.mark.parametrize("content", [b"a secret", b"<mujoco/>", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"])
def test_a_message_does_not_tell_whether_a_file_outside_is_there(tmp_path: Path, name: str, content: bytes) -> None:
    home, outside = tmp_path / "sent" / "assets", tmp_path / "outside.obj"
    home.mkdir(parents=True)
    text = REFERRING[name].replace("OUT", "../../outside.obj").replace("UP", "outside.obj")
    (home / name).write_text(text)

    def refuse() -> str:
        with pytest.raises(ProjectError) as refused:
            find_assets(InProcess(1), home)
        return str(refused.value)

    absent = refuse()
    outside.write_bytes(content)
    assert refuse() == absent
    assert "secret" not in absent and str(tmp_path) not in absent


def test_what_lies_beside_in_the_sent_folder_is_still_found(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "main.xml").write_text(f"<mujoco><include file='../shared/part.xml'/>{_BODY}</mujoco>")
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "part.xml").write_text("<mujocoinclude><option timestep='0.01'/></mujocoinclude>")
    assert find_assets(InProcess(1), tmp_path).names == ("robot/main.xml",)
