"""Labels of a project's hulls from a vision-language model: each asset is written as soon as all is said of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import HERE, Spread
from meshforge.errors import UsageError
from meshforge.project.labels.labelling import Labelled
from meshforge.project.labels.taking import Taker, gives_way
from meshforge.project.labels.vlm.drawing import Drawn, drawn
from meshforge.project.labels.vlm.settings import VlmSettings
from meshforge.symbolic import GIVEN_SOURCES, SymbolicMesh

if TYPE_CHECKING:
    from meshforge.perception.vlm import Bill, Client, Labeller, Pending, Said
    from meshforge.project.project import Project

Progress = Callable[["Bill"], None]
Keeping = Callable[[], AbstractContextManager[object]]


@dataclass(frozen=True, slots=True)
class VlmLabelled:
    """What came of asking a model. reports: of all assets, in their order; bill: what it cost.

    open: why hulls that were asked about have no label from it, by asset and hull; unasked: assets that were not come
    to, and ended: why, None where all were; blind: the model did not tell the colour of a red picture.
    """

    reports: tuple[Labelled, ...]
    usage: Bill
    open: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unasked: tuple[str, ...] = ()
    ended: str | None = None
    blind: bool = False


def label_with_vlm(
    project: Project,
    settings: VlmSettings,
    progress: Progress | None = None,
    stop: Callable[[], bool] | None = None,
    keeping: Keeping | None = None,
    spread: Spread = HERE,
) -> VlmLabelled:
    """Ask for labels of all hulls that have none of a person's or a file's, and write those that may be taken.

    progress: called for each asset, with what was spent so far; stop: says when to ask no more; keeping: the block in
    which all labels are written, in the end; None writes those of an asset as soon as all is said of it; spread: how
    the pictures are drawn, while questions are asked from this process.
    Raises MeshForgeError where nothing could be asked at all.
    """
    from meshforge.perception.vlm import Client, Labeller

    manner = settings.manner(project.vocabulary)
    client = Client(settings.endpoint(), project.layout.vlm, max_cost=settings.max_cost, stop=stop or (lambda: False))
    with (
        closing(client),
        closing(Labeller(client, manner, examples_of(project, settings))) as labeller,
        closing(drawn(project, manner, spread)) as pictures,
    ):
        run = _Run(project, client, labeller, keeping, progress)
        while not (client.end or (stop and stop())) and (found := next(pictures, None)):
            run.begin(*found)
        run.finish()
    return run.result()


class _Run:
    """Assets on their way: asked about at one time, written as they are done."""

    def __init__(
        self, project: Project, client: Client, labeller: Labeller, keeping: Keeping | None, progress: Progress | None
    ) -> None:
        self._project, self._client, self._labeller = project, client, labeller
        self._keeping, self._progress = keeping, progress
        self._taker = Taker(project)
        self._pending: dict[str, tuple[Mapping[str, str], Pending]] = {}
        self._reports: dict[str, Labelled] = {}
        self._open: dict[str, Mapping[str, str]] = {}
        self._unwritten: list[Callable[[], None]] = []

    def begin(self, asset: str, found: Drawn) -> None:
        """Ask about an asset; write those of which all is said by then."""
        if found.error:
            self._reports[asset] = Labelled(asset, problems=(found.error,))
            self._advance()
            return
        self._pending[asset] = found.hulls, self._labeller.ask(found.wanted, found.looks)
        for done in [name for name, (_, pending) in self._pending.items() if pending.is_done()]:
            self._write(done)

    def finish(self) -> None:
        """Wait for all answers, and write what they say."""
        for asset in list(self._pending):
            self._write(asset)
        if self._keeping and self._unwritten:
            with self._keeping():
                for write in self._unwritten:
                    write()

    def result(self) -> VlmLabelled:
        """What came of it all. Raises the error that ended it, where nothing came of it."""
        end, bill = self._client.end, self._client.usage
        if end and not bill.answered + bill.cached:
            raise end
        reports = tuple(self._reports[asset] for asset in self._project.assets() if asset in self._reports)
        unasked = tuple(asset for asset in self._project.assets() if asset not in self._reports)
        ended = end.message if end else "stopped" if unasked else None
        return VlmLabelled(reports, bill, self._open, unasked, ended, self._client.is_blind)

    def _write(self, asset: str) -> None:
        hulls, pending = self._pending.pop(asset)
        said = pending.result()
        end = self._client.end
        failed = tuple(problem for problem in said.failed if end is None or problem != end.sentence)
        if end and said.failed and not said.labels:
            return  # it is told once that the asking ended, and which assets were not come to
        if said.open:
            self._open[asset] = said.open
        if said.asked:
            _write_page(self._project.layout.vlm, asset, said)

        def write() -> None:
            report = self._taker.write(asset, hulls, said.labels, gives_way)
            self._reports[asset] = replace(report, problems=(*report.problems, *failed))

        if self._keeping:
            self._unwritten.append(write)
        else:
            write()
        self._advance()

    def _advance(self) -> None:
        if self._progress:
            self._progress(self._client.usage)


def _write_page(folder: Path, asset: str, said: Said) -> None:
    from meshforge.perception.vlm import write_page

    write_page(folder, asset, said)


def examples_of(project: Project, settings: VlmSettings) -> list[SymbolicMesh]:
    """The labelled assets that are shown as examples, with labels that somebody gave."""
    meshes = []
    for asset in settings.examples:
        mesh = project.mesh(asset)
        guessed = {hull.name: None for hull in mesh.hulls if hull.source not in GIVEN_SOURCES}
        if len(guessed) == len(mesh.hulls):
            remedy = "Label its hulls by hand, or take it out of examples in [vlm]."
            raise UsageError("this example has no label that a person or a file gave", where=asset, remedy=remedy)
        meshes.append(mesh.with_labels(guessed))
    return meshes
