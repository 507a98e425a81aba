"""Thumbnails: drawn in worker processes on request, and cached on disk."""

from concurrent.futures import Future
from pathlib import Path
from typing import Literal

from meshforge.batch import read_stamp
from meshforge.common import write_atomically
from meshforge.formats import load
from meshforge.geometry import digest
from meshforge.project import Project, output_digest
from meshforge.store import NotHereError, geometry_digest
from meshforge.studio.queries.assets import compute_upright, draw_thumbnail, output_picture_digest, picture_digest
from meshforge.studio.workers import Workers, future_of, project_of_one

ThumbnailOf = Literal["source", "output"]

MOST_THUMBNAILS = 4000
"""Pictures that stay when a studio is opened; the oldest go."""


class Thumbnails:
    """The thumbnails of a project; pages ask for few at once, what was wanted last first."""

    def __init__(self, folder: Path, workers: Workers) -> None:
        self._folder, self._workers = folder, workers
        remove_oldest(folder, MOST_THUMBNAILS)

    def get(self, project: Project, asset: str, of: ThumbnailOf, digest: str) -> Future[bytes]:
        """Return the thumbnail of an asset, or of its output, as a PNG file; digest: that of its card.

        The result is NotHereError where the asset looks otherwise by now, and has another digest therefore.
        """
        kept = self._folder / f"{digest}.png"
        if kept.is_file():
            return future_of(kept.read_bytes())
        return self._workers.start(_draw, project_of_one(project, asset), asset, of, digest, kept)


def _draw(project: Project, asset: str, of: ThumbnailOf, wanted: str, target: Path) -> bytes:
    """Draw what has a digest, and keep it as a file. project: with this asset alone."""
    source = project.mesh(asset)
    digests = {hull.name: digest(hull.shape) for hull in source.hulls}
    labels = [hull.annotation for hull in source.hulls]
    present = picture_digest(geometry_digest(digests), labels, project.settings.orient, project.settings.up)
    shown = source
    if of == "output":
        stamp = read_stamp(project.layout.edited, asset)
        present = output_picture_digest(present, output_digest(stamp) or "")
        shown = load(project.layout.edited / stamp.out) if stamp and present == wanted else source
    if present != wanted:
        raise NotHereError("there is no such picture any more", where=asset, remedy="Ask for the present one.")
    data = draw_thumbnail(shown, compute_upright(project, source)[0])
    write_atomically(target, data)
    return data


def remove_oldest(folder: Path, most: int) -> None:
    """Remove the oldest files of a folder, of which so many stay."""
    files = sorted(folder.glob("*.*"), key=lambda path: path.stat().st_mtime_ns)
    for path in files[:-most]:
        path.unlink(missing_ok=True)
