"""Reading the hull templates that a program names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from meshforge.errors import ProgramError
from meshforge.formats import read
from meshforge.language import Program, Template


def template_folders(program: Path) -> tuple[Path, ...]:
    """Where the templates of a program file are looked for: beside it, then in the folder templates/ there."""
    return program.parent, program.parent / "templates"


def load_templates(program: Program, folders: Sequence[Path]) -> dict[str, Template]:
    """The templates that a program names, by the path it writes, from the first folder that has each.

    Raises ProgramError: a template is in none of the folders, holds no hull, or is not convex.
    """
    return named_templates(program.templates, folders)


def named_templates(names: Iterable[str], folders: Sequence[Path]) -> dict[str, Template]:
    """The templates of these names; all else as of `load_templates`."""
    return {name: read_template(_found(name, folders), name) for name in names}


def read_template(path: Path, name: str) -> Template:
    """The template in a file. Raises ProgramError, naming it, where it holds no hull or is not convex."""
    asset = read(path)
    if asset.opaque:
        raise ProgramError(
            f'the template "{name}" is no convex hull: {asset.opaque[0].reason}',
            where=str(path),
            remedy=f"Split it into convex hulls first: meshforge decompose {path} -o {_split(path)}",
        )
    if not asset.geoms:
        raise ProgramError(f'the template "{name}" holds no hull', where=str(path))
    return Template(tuple(geom.shape for geom in asset.geoms), name)


def _found(name: str, folders: Sequence[Path]) -> Path:
    places = [folder / name for folder in folders]
    for place in places:
        if place.is_file():
            return place
    looked = ", then ".join(str(place) for place in places) or "no folder"
    raise ProgramError(f'the template "{name}" is not there', remedy=f"Looked for {looked}.")


def _split(path: Path) -> str:
    return str(path.with_name(f"{path.stem}_hulls{path.suffix}"))
