"""The viewer, with something in the place of viser that keeps what it is told."""

import sys
import time
import webbrowser
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import meshforge as mf
from tests.unit.rendering.scenes import table


class Server:
    """Keeps what is added to the scene, in the words of viser."""

    def __init__(self, **options: Any) -> None:
        self.options = options
        self.meshes: dict[str, dict[str, Any]] = {}
        self.clicks: dict[str, Any] = {}
        self.up, self.is_open = "", True
        self.text = SimpleNamespace(content="")
        self.scene = SimpleNamespace(set_up_direction=self._set_up, add_mesh_simple=self._add)
        self.gui = SimpleNamespace(add_markdown=lambda text: self.text)

    def _set_up(self, direction: str) -> None:
        self.up = direction

    def _add(self, name: str, vertices: Any, faces: Any, **looks: Any) -> Any:
        self.meshes[name] = {"vertices": vertices, "faces": faces, **looks}
        return SimpleNamespace(on_click=lambda done: self.clicks.setdefault(name, done))

    def get_port(self) -> int:
        return 4321

    def stop(self) -> None:
        self.is_open = False


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    fake = ModuleType("viser")
    fake.ViserServer = Server  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "viser", fake)
    pages: list[str] = []
    monkeypatch.setattr(webbrowser, "open", pages.append)
    return pages


def test_every_hull_is_in_the_scene_coloured_by_label(opened: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    server = table().show(wait=False)
    assert list(server.meshes) == [f"hulls/{h.name}" for h in table().hulls]
    colors = [server.meshes[f"hulls/{name}"]["color"] for name in ("left", "right", "leg0", "leg1")]
    assert colors[0] == colors[1] != colors[2] == colors[3] and all(0 <= share <= 255 for share in colors[0])
    assert server.meshes["hulls/left"]["vertices"].shape == (8, 3)
    assert server.up == "+z" and server.options["host"] == "127.0.0.1"
    assert opened == ["http://127.0.0.1:4321"] and "5 hulls" in capsys.readouterr().out


def test_a_click_tells_the_name_of_the_hull(opened: list[str]) -> None:
    server = table().show(wait=False, browser=False)
    server.clicks["hulls/leg1"](None)
    assert server.text.content.startswith("**leg1**") and "label leg" in server.text.content
    assert opened == []


def test_in_a_script_it_stays_open_until_ctrl_c(opened: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(_: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(time, "sleep", interrupt)
    assert not table().show().is_open
    monkeypatch.setattr(sys, "ps1", ">>> ", raising=False)
    assert table().show().is_open


def test_without_viser_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(mf.MeshForgeError, match=r"needs the package viser.*\n.*pip install 'meshforge\[viewer\]'"):
        table().show()
