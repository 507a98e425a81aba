"""MJCF in memory: text, and `mujoco.MjSpec`, read as a file in the folder from which their references count; and
output as a spec."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from meshforge.common import AssetError, is_file, plain_path
from meshforge.formats.base import Output
from meshforge.formats.libraries import make_folder, mujoco
from meshforge.formats.mjcf.document import read_tree
from meshforge.symbolic import Asset


@runtime_checkable
class SpecObject(Protocol):
    """A `mujoco.MjSpec`."""

    assets: Any
    modelfiledir: Any
    modelname: Any

    def to_xml(self) -> str:
        """Its XML."""


def read_text(text: str) -> Asset:
    """The asset in the text of an MJCF; its references count from the current folder. Raises AssetError."""
    from meshforge.formats.mjcf.read import read_mjcf  # lazy: only MJCF needs it

    path = Path.cwd() / "text.xml"
    return read_mjcf(path, {path: text.encode()})


def read_spec(spec: SpecObject) -> Asset:
    """The asset in a spec, as its XML says it.

    References count from the folder that the spec was read from. Files that it holds in memory are put into a folder
    that lasts as long as this process, together with those on disk. Raises AssetError.
    """
    from meshforge.formats.mjcf.read import read_mjcf  # lazy: only MJCF needs it

    name = f"{Path(str(spec.modelname or 'spec')).name}.xml"
    folder = plain_path(Path(str(spec.modelfiledir or "")).absolute())
    try:
        text = spec.to_xml().encode()
    except (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        raise AssetError(f"MuJoCo cannot write this spec: {error}", where=name) from error
    held = {str(key): bytes(data) for key, data in dict(spec.assets or {}).items()}
    if not held:
        return read_mjcf(folder / name, {folder / name: text})
    home = make_folder()
    for path, data in _gather_files(folder / name, text, held):
        _put(home / path.name if not path.is_relative_to(folder) else home / path.relative_to(folder), data)
    _put(home / name, text)
    return read_mjcf(home / name)


def _gather_files(main: Path, text: bytes, held: dict[str, bytes]) -> list[tuple[Path, bytes]]:
    """The files that a text refers to: those that the spec holds, under its names for them, before those on disk."""
    from meshforge.formats.mjcf.references import list_references  # lazy: only MJCF needs it

    found = []
    for reference in list_references(read_tree(main, {main: text})):
        path = reference.path
        below = path.relative_to(main.parent).as_posix() if path.is_relative_to(main.parent) else path.name
        key = next((key for key in (reference.text, below, path.name, str(path)) if key in held), None)
        if key is not None:
            found.append((path, held[key]))
        elif is_file(path):
            found.append((path, path.read_bytes()))
    return found


def _put(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def build_spec(output: Output) -> Any:
    """The spec of an output, which holds all of its files. Raises AssetError where MuJoCo refuses it."""
    files = {name: path.read_bytes() for name, path in output.copies.items()} | output.made
    files = {os.path.normpath(name): data for name, data in files.items()}
    included = {name: data for name, data in files.items() if name.endswith((".xml", ".mjcf"))}
    assets = {name: data for name, data in files.items() if name not in included}
    try:
        return mujoco.MjSpec.from_string(output.main.decode(), include=included, assets=assets)
    except (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        raise AssetError(f"MuJoCo refuses it: {' '.join(str(error).split())}") from error
