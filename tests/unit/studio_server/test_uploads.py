from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from meshforge.common import UsageError
from meshforge.studio.errors import TooLargeError
from meshforge.studio.uploads import Uploads, confine_path, save_stream


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


def test_a_file_that_is_too_large_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(TooLargeError):
        asyncio.run(save_stream(tmp_path / "a", chunks(b"123", b"456"), 5))
    assert not list(tmp_path.iterdir())
    asyncio.run(save_stream(tmp_path / "a", chunks(b"123", b"45"), 5))
    assert (tmp_path / "a").read_bytes() == b"12345"


def test_a_file_in_the_place_of_a_folder_is_one_message(tmp_path: Path) -> None:
    uploads = Uploads(tmp_path / "uploads")
    asyncio.run(uploads.put("a", chunks(b"1")))
    with pytest.raises(UsageError, match="same name"):
        asyncio.run(uploads.put("a/b", chunks(b"1")))
    assert uploads.list_files()[1] == ("a",)


def test_what_was_sent_to_an_earlier_studio_is_gone(tmp_path: Path) -> None:
    asyncio.run(Uploads(tmp_path / "uploads").put("a", chunks(b"1")))
    assert Uploads(tmp_path / "uploads").list_files()[1] == ()
