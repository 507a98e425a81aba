"""Measuring outputs when that is asked for: one part of one of them, its pictures, or all."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from pathlib import Path
from typing import TypeVar

from meshforge.batch import Lost, isolated, read_stamp
from meshforge.batch.workers.memory import share
from meshforge.batch.workers.pool import processors
from meshforge.checks import examine_mesh, pictures
from meshforge.errors import MeshForgeError, ProjectError, told
from meshforge.project import Project
from meshforge.studio.checking.key import check_key
from meshforge.studio.checking.measuring import MEASURES, measured
from meshforge.studio.checking.pair import Work, pair_of
from meshforge.studio.checking.shelf import Shelf
from meshforge.studio.errors import NotHereError
from meshforge.studio.wire.checks import Checked, CheckPicture, Fault, Part
from meshforge.studio.workers import TIMEOUT, Workers, alone
from meshforge.views import png

SIZE = (800, 600)
Result = TypeVar("Result")


class Checks:
    """The checks of a project's outputs. workers: for what pages look at; what is cancelled ends at once."""

    def __init__(self, folder: Path, workers: Workers) -> None:
        self._cache, self._workers = Shelf(folder), workers
        self._faults: dict[str, tuple[Fault, ...]] = {}
        self._cache.remove_oldest()

    def check_part(self, project: Project, asset: str, part: Part) -> Future[Checked]:
        """One part of what is measured of an asset's output; as `arrived`. Raises ProjectError without one."""
        work = _work(project, asset)
        kept = self._cache.read(work.key, part)
        return _done(kept) if kept else self._workers.start(_measure, work, part, self._cache)

    def draw_pictures(self, project: Project, asset: str, part: Part) -> Future[tuple[CheckPicture, ...]]:
        """The pictures of a part, which are drawn first. Raises ProjectError where there is no output."""
        work = _work(project, asset)
        kept = self._cache.read_pictures(work.key, part)
        return _done(kept) if kept is not None else self._workers.start(_draw, work, part, self._cache)

    def read_picture(self, asset: str, key: str, name: str) -> bytes:
        """A picture that was drawn. Raises NotHereError where it was not."""
        try:
            return self._cache.picture_path(key, name).read_bytes()
        except OSError:
            raise NotHereError("there is no such picture", where=asset) from None

    def faults_of(self, key: str | None) -> tuple[Fault, ...] | None:
        """What was found of the output of a key, None where not all of it is measured."""
        if key is None:
            return None
        if key not in self._faults and (found := self._cache.read_faults(key)) is not None:
            self._faults[key] = found
        return self._faults.get(key)

    def check_all(
        self, project: Project, assets: Sequence[str], done: Callable[[], None], stop: Callable[[], bool]
    ) -> Iterator[tuple[str, tuple[Fault, ...] | str]]:
        """What is found of the outputs of some assets, or why it cannot be told; those measured already come first.

        done: called whenever one is over. Raises StoppedError where it was told to stop; what was measured stays.
        """
        fresh = []
        for asset in assets:
            try:
                work = _work(project, asset)
            except ProjectError as error:  # its output went meanwhile
                done()
                yield asset, error.sentence
                continue
            if self._cache.missing_parts(work.key):
                fresh.append(work)
            else:
                done()
                yield asset, self.faults_of(work.key) or ()
        bound = share(min(processors(), max(len(fresh), 1)))
        todo = [(work, self._cache) for work in fresh]
        results = isolated(_measure_all, todo, timeout=TIMEOUT, memory=bound, done=done, stop=stop)
        for work, result in zip(fresh, results, strict=True):
            problem = result.why if isinstance(result, Lost) else result
            yield work.asset, problem or self.faults_of(work.key) or ()


def _work(project: Project, asset: str) -> Work:
    key = check_key(read_stamp(project.layout.edited, asset))
    if key is None:
        raise ProjectError("it has no output that could be checked", where=asset, remedy="Apply the program.")
    return Work(alone(project, asset), asset, key)


def _measure(work: Work, part: Part, shelf: Shelf) -> Checked:
    checked = measured(pair_of(work), part)
    shelf.write(work.key, checked)
    return checked


def _measure_all(work: tuple[Work, Shelf]) -> str | None:
    """Measure what is missing; why that is not possible, None where it is."""
    what, shelf = work
    problem = None
    try:
        pair = pair_of(what)
        for part in shelf.missing_parts(what.key):
            try:
                shelf.write(what.key, measured(pair, part))
            except MeshForgeError as error:  # the other parts can still be measured
                problem = problem or error.sentence
    except Exception as error:  # one that fails never stops the others
        return told(error)
    return problem


def _draw(work: Work, part: Part, shelf: Shelf) -> tuple[CheckPicture, ...]:
    pair = pair_of(work)
    found = examine_mesh(pair.after, MEASURES[part], pair.before) if part in MEASURES else None
    rows = pictures(pair.after, found, SIZE) if found else ()
    drawn = [(CheckPicture(name=name, text=text), png(image)) for name, text, image in rows]
    shelf.write_pictures(work.key, part, drawn)
    return tuple(picture for picture, _ in drawn)


def _done(result: Result) -> Future[Result]:
    future: Future[Result] = Future()
    future.set_result(result)
    return future
