"""Labels out of PartNet-Mobility's `semantics.txt`: what the links of an asset are."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from meshforge.common import AssetError
from meshforge.labels.from_files.base import FileLabels, Meaning, meaning_of, to_file_labels
from meshforge.labels.names.label_by_names import HullNames, NamePattern, names_of_mesh
from meshforge.labels.names.words import EXACT
from meshforge.symbolic import SymbolicMesh

SEMANTICS_FILE = "semantics.txt"
"""The name of such a file."""
_LINKS_SUFFIX = ".urdf"  # the format whose links it is about
_REMEDY = "Each line has a link, the kind of its joint and what it is: link_0 hinge rotation_door."


def semantics_beside(asset: Path) -> Path | None:
    """Return the file beside an asset, None where there is none."""
    file = asset.with_name(SEMANTICS_FILE)
    return file if asset.suffix.lower() == _LINKS_SUFFIX and file.is_file() else None


def read_semantics(path: Path) -> Mapping[str, str]:
    """Return what links are, by their names, in the order of the file.

    Raises AssetError with the line: it cannot be read, a line of other than three words, a link listed twice.
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        why = "not UTF-8 text" if isinstance(error, UnicodeDecodeError) else error.strerror
        raise AssetError(f"the semantics cannot be read ({why})", where=str(path)) from error
    found: dict[str, str] = {}
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words:
            continue
        if len(words) != 3:
            problem = f"this line has {len(words)} words, not three: {line.strip()[:60]!r}"
            raise AssetError(problem, where=f"{path}:{number}", remedy=_REMEDY)
        if words[0] in found:
            problem = f"the link {words[0]!r} is listed twice"
            raise AssetError(problem, where=f"{path}:{number}", remedy="Keep one line.")
        found[words[0]] = words[2]
    if not found:
        raise AssetError("it lists no link", where=str(path), remedy=_REMEDY)
    return found


def label_by_links(
    mesh: SymbolicMesh, path: Path, vocabulary: Sequence[str], patterns: Sequence[NamePattern]
) -> FileLabels:
    """Return what a file says of the hulls of an asset.

    A hull whose own names say another label of the vocabulary, and that alone, is that: PartNet calls what is on a link
    by its finer parts, `handle-7` on a drawer.
    Raises AssetError: it cannot be read, or names no link of this asset.
    """
    semantics = read_semantics(path)
    links = {body.name for body in mesh.asset.bodies} if mesh.asset else set()
    if links.isdisjoint(semantics):
        raise AssetError("it lists no link of this asset", where=str(path))
    own = (names for names in names_of_mesh(mesh) if names.body in semantics)
    found_names = {names.hull: (*_interpret(names, semantics[names.body], vocabulary, patterns), 1.0) for names in own}
    found = to_file_labels(found_names, vocabulary)
    gone = [f"there is no link {link!r}" for link in semantics if link not in links]
    return FileLabels(found.labels, found.names, [*found.problems, *gone])


def _interpret(
    own: HullNames, semantic: str, vocabulary: Sequence[str], patterns: Sequence[NamePattern]
) -> tuple[str, Meaning]:
    of_link = meaning_of(semantic, vocabulary, patterns)
    for _, name in own.own_names():
        meaning = meaning_of(name, vocabulary, patterns)
        if meaning and meaning[1] >= EXACT and not (of_link and meaning[0] == of_link[0]):
            return name, meaning
    return semantic, of_link
