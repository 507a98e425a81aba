"""What a change of some files of a project means: which assets, whether their hulls, whether there is more to learn."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from meshforge.batch import SETTINGS, STATE
from meshforge.files import relative_name
from meshforge.project import Project

PROGRAM, PREVIOUS, LEARNED = "program.mf", "program.previous.mf", f"{STATE}/learned.json"
_STAMPS = f"edited/{STATE}/stamps/"
_OF_ASSETS = ("labels/", "demonstrations/", "corrections/", _STAMPS)
_LESSONS = ("labels/", "demonstrations/", "prepared/", "templates/")
_SAID = frozenset(("answers.json", "review.json", PROGRAM))


@dataclass(frozen=True, slots=True)
class Changes:
    """assets: ids of which something changed; shapes: those of them whose hulls may be others.

    settings, program: whether these changed; reviews: what was said about outputs; lesson: whether there is other to
    learn from.
    """

    assets: frozenset[str] = field(default_factory=frozenset)
    shapes: frozenset[str] = field(default_factory=frozenset)
    settings: bool = False
    program: bool = False
    reviews: bool = False
    learning: bool = False


def changes_of(project: Project, names: Iterable[str]) -> Changes:
    """What a change of files means; names: paths from the project's folder."""
    names = frozenset(names)
    prepared = {name.removeprefix("prepared/").rpartition("/")[0] for name in names if name.startswith("prepared/")}
    files = {relative_name(path, project.folder): asset for asset, path in project.found.ids.items()}
    shapes = (prepared | {files[name] for name in names if name in files}) & project.found.ids.keys()
    kept = {name: kind for kind in _OF_ASSETS for name in names if name.startswith(kind)}
    own = {name.removeprefix(kind).removesuffix(".json") for name, kind in kept.items()}
    settings = SETTINGS in names
    return Changes(
        assets=frozenset(project.assets()) if settings else frozenset((own & project.found.ids.keys()) | shapes),
        shapes=frozenset(shapes),
        settings=settings,
        program=bool(names & {PROGRAM, LEARNED}),
        reviews="review.json" in names,
        learning=settings or bool(shapes) or any(n.startswith(_LESSONS) or n in _SAID for n in names),
    )
