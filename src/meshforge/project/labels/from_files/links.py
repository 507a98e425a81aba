"""Labels out of PartNet-Mobility's `semantics.txt`: hulls are what their links are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.formats.segmented import read_semantics
from meshforge.perception.names import EXACT, Names, Pattern
from meshforge.project.labels.from_files.class_meanings import Meaning, meaning_of
from meshforge.project.labels.from_files.given import Given, unknown
from meshforge.project.labels.naming import names_in
from meshforge.symbolic import Label, SymbolicMesh


def link_labels(mesh: SymbolicMesh, path: Path, vocabulary: Sequence[str], patterns: Sequence[Pattern]) -> Given:
    """What a file says of the hulls of an asset.

    A hull whose own names say another label of the vocabulary, and that alone, is that: PartNet calls what is on a link
    by its finer parts, `handle-7` on a drawer.
    Raises AssetError: it cannot be read, or tells of no link of this asset.
    """
    semantics = {one.link: one.name for one in read_semantics(path)}
    links = {body.name for body in mesh.asset.bodies} if mesh.asset else set()
    if links.isdisjoint(semantics):
        raise AssetError("it tells of no link of this asset", where=str(path))
    labels, names, odd = dict[str, Label](), dict[str, str](), Counter[str]()
    for own in names_in(mesh):
        if own.body not in semantics:
            continue
        name, meaning = _meant(own, semantics[own.body], vocabulary, patterns)
        names[own.hull] = name
        if meaning is None:
            odd[name] += 1
        elif meaning.label:
            labels[own.hull] = Label(meaning.label, meaning.sure, "file")
    gone = [f"there is no link {link!r}" for link in semantics if link not in links]
    return Given(labels, names, [*(unknown(name, count, vocabulary) for name, count in odd.items()), *gone])


def links_said(path: Path) -> list[str]:
    """What links are, in the order of the file, each once."""
    return list(dict.fromkeys(one.name for one in read_semantics(path)))


def _meant(
    own: Names, semantic: str, vocabulary: Sequence[str], patterns: Sequence[Pattern]
) -> tuple[str, Meaning | None]:
    """What a hull is called, and what that means."""
    of_link = meaning_of(semantic, vocabulary, patterns)
    for _, name in own.own_names():
        meaning = meaning_of(name, vocabulary, patterns)
        if meaning and meaning.sure >= EXACT and not (of_link and meaning.label == of_link.label):
            return name, meaning
    return semantic, of_link
