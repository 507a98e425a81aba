"""Thumbnails: drawn in worker processes on request, the latest request first, and cached on disk."""

from concurrent.futures import CancelledError, Future
from functools import partial
from pathlib import Path
from threading import Lock
from typing import Literal

from meshforge.batch import read_stamp
from meshforge.common import MeshForgeError, write_atomically
from meshforge.formats import load
from meshforge.geometry import digest
from meshforge.project import Project, output_digest
from meshforge.store import NotHereError, geometry_digest
from meshforge.studio.queries.assets import compute_upright, draw_thumbnail, output_picture_digest, picture_digest
from meshforge.studio.workers import Workers, future_of, project_of_one, wait_for

ThumbnailOf = Literal["source", "output"]

MOST_THUMBNAILS = 4000
"""Pictures that stay when a studio is opened; the oldest go."""


_Work = tuple[Project, str, ThumbnailOf, str, Path]
"""The arguments of `_draw`."""


class Thumbnails:
    """The thumbnails of a project. A request that is already waiting is not put in twice."""

    def __init__(self, folder: Path, workers: Workers) -> None:
        self._folder, self._workers = folder, workers
        self._lock = Lock()
        self._waiting: dict[str, tuple[_Work, Future[bytes]]] = {}
        self._drawing: dict[str, Future[bytes]] = {}
        remove_oldest(folder, MOST_THUMBNAILS)

    def get(self, project: Project, asset: str, of: ThumbnailOf, digest: str) -> Future[bytes]:
        """Return the thumbnail of an asset, or of its output, as a PNG file; digest: that of its card.

        The result is NotHereError where the asset looks otherwise by now, and has another digest therefore.
        """
        kept = self._folder / f"{digest}.png"
        if kept.is_file():
            return future_of(kept.read_bytes())
        wanted = project_of_one(project, asset), asset, of, digest, kept
        with self._lock:
            if digest in self._drawing:
                return self._drawing[digest]
            work, future = self._waiting.pop(digest, (wanted, Future[bytes]()))
            self._waiting[digest] = work, future  # now the one that was asked for last
        self._start_next()
        return future

    def _start_next(self) -> None:
        with self._lock:
            if not self._waiting or len(self._drawing) >= self._workers.count:
                return
            digest, (work, future) = self._waiting.popitem()
            self._drawing[digest] = future
        try:
            self._workers.start(_draw, *work).add_done_callback(partial(self._end, digest, future))
        except MeshForgeError as error:  # the studio is being closed
            self._finish(digest)
            future.set_exception(error)

    def _end(self, digest: str, future: Future[bytes], drawn: Future[bytes]) -> None:
        self._finish(digest)
        if not future.done():  # who asked for it may have left
            try:
                future.set_result(wait_for(drawn))
            except (Exception, CancelledError) as error:
                known = isinstance(error, MeshForgeError)
                future.set_exception(error if known else MeshForgeError(f"this was not drawn: {error}"))
        self._start_next()

    def _finish(self, digest: str) -> None:
        with self._lock:
            del self._drawing[digest]


def _draw(project: Project, asset: str, of: ThumbnailOf, wanted: str, target: Path) -> bytes:
    """Draw what has a digest, and keep it as a file. project: with this asset alone."""
    source = project.mesh(asset)
    digests = {hull.name: digest(hull.shape) for hull in source.hulls}
    labels = [hull.annotation for hull in source.hulls]
    present = picture_digest(geometry_digest(digests), labels, project.settings.orient)
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
