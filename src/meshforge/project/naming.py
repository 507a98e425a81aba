"""Labels taken from names: hulls and bodies are often called what they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError, ProjectError
from meshforge.project.labelling import Labelled, merged, write_merged
from meshforge.symbolic import Label

if TYPE_CHECKING:
    from meshforge.project.project import Project

CONFIDENCE = 0.7
"""How sure a label is that was taken from a name: names are given by people, though not for this."""
_NAMELESS = "body"  # what formats without bodies call the only one

Words = tuple[str, ...]


def label_from_names(project: Project) -> tuple[Labelled, ...]:
    """Give these labels; a problem with one asset is told in its report. Raises ProjectError: no vocabulary."""
    if not project.vocabulary:
        remedy = "Say first what hulls can be."
        raise ProjectError("the vocabulary is empty", where=str(project.folder), remedy=remedy)
    return tuple(_labelled(project, asset) for asset in project.assets())


def _labelled(project: Project, asset: str) -> Labelled:
    with project.lock():
        try:
            mesh = project.mesh(asset)
        except MeshForgeError as error:
            return Labelled(asset, problems=(error.message,))
        vocabulary = project.vocabulary
        bare = {hull.name: hull.body for hull in mesh.hulls if hull.label is None}
        given = {name: Label(label, CONFIDENCE, "name") for name, label in named_labels(bare, vocabulary).items()}
        labelled, report = merged(asset, mesh, given, vocabulary)
        if report.taken:
            write_merged(project, asset, labelled)
        return report


def named_labels(hulls: Mapping[str, str], vocabulary: Sequence[str]) -> dict[str, str]:
    """The labels that names say, by hull; hulls: the name of the body of each by its own name."""
    known = {label: words_of(label) for label in vocabulary}
    found = ((name, _of_hull(name, body, known)) for name, body in hulls.items())
    return {name: label for name, label in found if label}


def _of_hull(name: str, body: str, known: Mapping[str, Words]) -> str | None:
    """The label in the hull's own name, or where that has none, in the name of its body."""
    own = _mentioned(name.removeprefix(f"{body}/"), known)
    of_body = [] if own or body == _NAMELESS else _mentioned(body, known)
    return _longest(own or of_body)


def _mentioned(name: str, known: Mapping[str, Words]) -> list[str]:
    """The labels whose words, one or several in a row, are in a name."""
    words = words_of(name)
    return [label for label, wanted in known.items() if _holds(words, wanted)]


def _holds(words: Words, wanted: Words) -> bool:
    runs = (words[k : k + len(wanted)] for k in range(len(words) - len(wanted) + 1))
    return bool(wanted) and any(all(map(_same, run, wanted)) for run in runs)


def _same(one: str, other: str) -> bool:
    """Whether two words are the same, be it in the plural."""
    return not _forms(one).isdisjoint(_forms(other))


def _forms(word: str) -> set[str]:
    return {word, word.removesuffix("s"), word.removesuffix("es")} - {""}


def _longest(labels: Sequence[str]) -> str | None:
    """The label of most letters; None where several have as many."""
    lengths = {label: sum(map(len, words_of(label))) for label in labels}
    best = [label for label, length in lengths.items() if length == max(lengths.values())]
    return best[0] if len(best) == 1 else None


def words_of(name: str) -> Words:
    """The words in a name, in lower case: `leftDoor_2` and `left-door` have two, `URDFLink` too."""
    spaced = "".join(
        f" {here}" if here.isupper() and (not before.isupper() or after.islower()) else here if here.isalpha() else " "
        for before, here, after in zip(f" {name}", name, f"{name[1:]} ", strict=False)
    )
    return tuple(spaced.casefold().split())
