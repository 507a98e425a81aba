"""Taking labels that a machine or a file gives for one asset after another, beside what its labels are by then."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from meshforge.errors import AssetError
from meshforge.files import changed_at
from meshforge.project.labels.labelling import Labelled, merged, write_merged
from meshforge.symbolic import GIVEN_SOURCES, Label, label_homes

if TYPE_CHECKING:
    from meshforge.project.project import Project

Report = Callable[[Labelled], None]
"""Called with what became of an asset, as soon as that is known; assets come in their order."""
May = Callable[[Label | None, Label], bool]
"""Whether a label, or none, may be replaced by a given one at all; what people said stays in any case."""


class Taker:
    """Writes labels of assets, each under the lock of the project, which others may change at the same time."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._seen: object = None
        self._vocabulary: tuple[str, ...] = ()

    @property
    def vocabulary(self) -> tuple[str, ...]:
        """The vocabulary as it is now; settings that name very many assets are not parsed for each of them."""
        now = changed_at(self._project.layout.settings)
        if now != self._seen:
            self._seen, self._vocabulary = now, self._project.vocabulary
        return self._vocabulary

    def try_write(self, asset: str, hulls: Mapping[str, str], given: Mapping[str, Label], may: May) -> Labelled:
        """The same; that the labels that there are cannot be read is told in the report."""
        try:
            return self.write(asset, hulls, given, may)
        except AssetError as error:
            return Labelled(asset, problems=(error.message,))

    def write(self, asset: str, hulls: Mapping[str, str], given: Mapping[str, Label], may: May) -> Labelled:
        """Write those of the labels that may be taken: they may have been looked for for a long time.

        hulls: digests by name, in order. Raises AssetError where the labels that there are cannot be read.
        """
        with self._project.lock():
            current = label_homes(self._project.labels(asset), hulls).labels
            wanted = {name: label for name, label in given.items() if may(current.get(name), label)}
            labels, report = merged(asset, hulls, current, wanted, self.vocabulary)
            if report.taken:
                write_merged(self._project, asset, hulls, labels, self.vocabulary)
        return report


def unheard(report: Labelled) -> None:
    """The report where nobody wants it."""


def any_may(current: Label | None, given: Label) -> bool:
    """Every label may be replaced, of those that are not a person's."""
    return True


def none_there(current: Label | None, given: Label) -> bool:
    """Only hulls without a label get one."""
    return current is None


def gives_way(current: Label | None, given: Label) -> bool:
    """Whether a label may be replaced: an earlier one of that machine, or one that another was less sure of."""
    if current is None or current.source == given.source:
        return True
    return current.source not in GIVEN_SOURCES and current.confidence < given.confidence
