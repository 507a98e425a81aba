"""review.json: which edited assets a person has accepted, and which are flagged for another look."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pydantic import Field

from meshforge.batch import Stamp, read_stamp, text_digest
from meshforge.errors import ProjectError
from meshforge.project.json_files import JsonFile, read_json, write_json

if TYPE_CHECKING:
    from meshforge.project.project import Project

Verdict = Literal["accepted", "flagged"]


class Review(JsonFile):
    """What a person said about one edited asset; output: the digest of the files that were looked at."""

    verdict: Verdict
    note: str | None = None
    output: str | None = None


class ReviewFile(JsonFile):
    """All reviews, by asset."""

    assets: dict[str, Review] = Field(default_factory=dict)


def reviews(path: Path) -> dict[str, Review]:
    """All reviews, by asset."""
    return (read_json(path, ReviewFile) or ReviewFile()).assets


def review(project: Project, assets: Iterable[str], verdict: Verdict | None, note: str | None) -> None:
    """Set or take back what is said about the outputs of some assets, in one write.

    Raises ProjectError, with nothing written, where one of them has no output that a verdict could be about.
    """
    own = {asset: _said(project, asset, verdict, note) for asset in assets}
    with project.lock():
        kept = read_json(project.layout.review, ReviewFile) or ReviewFile()
        now = {asset: said for asset, said in (kept.assets | own).items() if said}
        if now != kept.assets:
            write_json(project.layout.review, kept.model_copy(update={"assets": dict(sorted(now.items()))}))


def _said(project: Project, asset: str, verdict: Verdict | None, note: str | None) -> Review | None:
    project.path(asset)
    output = output_digest(read_stamp(project.layout.edited, asset))
    if verdict and not output:
        raise ProjectError(
            f"{asset} has no output to be {verdict}",
            where=str(project.folder),
            remedy=f"Make it: meshforge apply {project.folder}",
        )
    return Review(verdict=verdict, note=note, output=output) if verdict else None


def output_digest(stamp: Stamp | None) -> str | None:
    """One digest of all files of an output, None where there is none."""
    if not stamp or stamp.status not in ("edited", "unchanged"):
        return None
    return text_digest("\n".join(f"{name} {digest}" for name, digest in sorted(stamp.outputs.items())))
