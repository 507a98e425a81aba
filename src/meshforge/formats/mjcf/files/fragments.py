"""Files that are no model by themselves: fragments, which other files include."""

from __future__ import annotations

from pathlib import Path

from meshforge.errors import AssetError, MeshForgeError
from meshforge.files import plain_path
from meshforge.formats.mjcf.files.sources import Tree, gather
from meshforge.formats.triangles import contents
from meshforge.formats.xml import Element, Text, parsed
from meshforge.words import listed

_LEVELS = 3  # folders above a fragment in which a file that includes it may lie
_MOST_FILES, _MOST_BYTES = 200, 2_000_000  # looked at in each folder, and read of each file


def gather_model(path: Path) -> Tree:
    """The tree of a file that is a model. Raises AssetError; for a fragment, one that names what to open instead."""
    try:
        tree = gather(path)
    except AssetError:  # an include of a fragment is found from the folder of the model
        _refuse_fragment(plain_path(path), parsed(Text.of(contents(path)).data, str(path)))
        raise
    _refuse_fragment(tree.main.path, tree.root.element)
    return tree


def _refuse_fragment(path: Path, root: Element) -> None:
    """Raise AssetError where the root of a file is not `<mujoco>`."""
    tag, where = root.tag, f"{path}:{root.line}"
    if tag.lower() == "mujoco":
        return
    homes = _homes(path)
    if homes or tag == "mujocoinclude":
        remedy = (
            f"Open {listed([str(home) for home in homes], 3)}, which {'includes' if len(homes) == 1 else 'include'} it."
            if homes
            else f"Open the file that includes it; none was found in its folder or the {_LEVELS} above."
        )
        raise AssetError(f"is a part of a model, to be included by another file: <{tag}>", where=where, remedy=remedy)
    problem = f"is no MJCF: its root element is <{tag}>, not <mujoco>"
    raise AssetError(problem, where=where, remedy="It is a URDF: name it .urdf." if tag == "robot" else None)


def _homes(fragment: Path) -> list[Path]:
    """The models near a fragment that include it."""
    folders = [fragment.parent, *fragment.parent.parents[:_LEVELS]]
    return [path for folder in folders for path in _candidates(folder) if _includes(path, fragment)]


def _candidates(folder: Path) -> list[Path]:
    try:
        return sorted(folder.glob("*.xml"))[:_MOST_FILES]
    except OSError:
        return []


def _includes(path: Path, fragment: Path) -> bool:
    try:
        if path == fragment or not path.is_file() or path.stat().st_size > _MOST_BYTES:
            return False
        if b"<include" not in path.read_bytes():
            return False
        tree = gather(path)
    except (MeshForgeError, OSError):
        return False
    return tree.root.tag.lower() == "mujoco" and any(source.path == fragment for source in tree.sources)
