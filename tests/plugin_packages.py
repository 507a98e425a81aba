"""Packages of plug-ins for tests: that of docs/plugins.md, and small ones that do one thing wrong."""

from __future__ import annotations

import re
import tomllib
import zipfile
from collections.abc import Mapping
from pathlib import Path

PAGE = Path(__file__).parents[1] / "docs" / "plugins.md"
_BLOCK = re.compile(r'```\w+ title="([^"]+)"\n(.*?)```', re.DOTALL)
Points = Mapping[str, Mapping[str, str]]
"""By group, the targets by name."""


def page_files() -> dict[str, str]:
    """The files that the page shows, by name."""
    return dict(_BLOCK.findall(PAGE.read_text(encoding="utf-8")))


def page_commands() -> list[str]:
    """The `meshforge` commands of the page, in order."""
    blocks = re.findall(r"```sh\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return [line for block in blocks for line in block.splitlines() if line.startswith("meshforge ")]


def build_example(folder: Path) -> Path:
    """The wheel of the package that the page shows: what a build backend makes, without one."""
    files = page_files()
    project = tomllib.loads(files["pyproject.toml"])["project"]
    modules = {name: text for name, text in files.items() if name.endswith(".py")}
    modules["meshforge_example/__init__.py"] = '"""An example of each plug-in."""\n'
    return build_wheel(folder, project["name"], project["version"], modules, project["entry-points"])


def build_wheel(folder: Path, package: str, version: str, modules: Mapping[str, str], points: Points) -> Path:
    """A wheel of a pure package."""
    stem = f"{package.replace('-', '_')}-{version}"
    lines = [f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in own.items()) for group, own in points.items()]
    info = {
        "METADATA": f"Metadata-Version: 2.1\nName: {package}\nVersion: {version}\n",
        "WHEEL": "Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        "entry_points.txt": "\n".join(lines),
    }
    files = {**modules, **{f"{stem}.dist-info/{name}": text for name, text in info.items()}}
    record = "".join(f"{name},,\n" for name in [*files, f"{stem}.dist-info/RECORD"])
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{stem}-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as wheel:
        for name, text in {**files, f"{stem}.dist-info/RECORD": record}.items():
            wheel.writestr(name, text)
    return path


def unpack(wheel: Path, target: Path) -> Path:
    """Install a pure wheel as pip does: by unpacking it."""
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(target)
    return target
