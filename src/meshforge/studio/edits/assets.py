"""Edits of assets, labelled, added, prepared before any program, reviewed and corrected after it; of the vocabulary."""

from pathlib import Path
from typing import Literal

from pydantic import Field

from meshforge.batch import action_text
from meshforge.common import join_names, pluralize
from meshforge.project import Project, list_renamed_files
from meshforge.signoff import ExclusionReason
from meshforge.store import Layout, list_files
from meshforge.studio.actions import read_action
from meshforge.studio.edits.base import Edit, LabelsByAsset
from meshforge.studio.wire.program import ActionCall
from meshforge.symbolic import is_class_name


class LabelHulls(Edit):
    """Label some hulls, given by name for each asset; null takes their labels away."""

    kind: Literal["label"] = "label"
    hulls: dict[str, tuple[str, ...]]
    label: str | None

    def apply(self, project: Project) -> None:
        project.set_labels_of(self.list_labels())

    def list_labels(self) -> LabelsByAsset:
        return {asset: dict.fromkeys(names, self.label) for asset, names in self.hulls.items()}

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return tuple(map(project.layout.labels, self.hulls))

    def describe(self, project: Project) -> str:
        hulls = f"{pluralize(sum(map(len, self.hulls.values())), 'hull')} of {_count_or_name(tuple(self.hulls))}"
        return f"{hulls} labelled {self.label}" if self.label else f"label of {hulls} taken away"


class SetVocabulary(Edit):
    """Set the labels that hulls can have, in the order of their colours."""

    kind: Literal["vocabulary"] = "vocabulary"
    touches = (Layout.settings,)
    labels: tuple[str, ...]

    def apply(self, project: Project) -> None:
        project.set_vocabulary([label for label in self.labels if not is_class_name(label)])

    def describe(self, project: Project) -> str:
        return f"vocabulary: {', '.join(self.labels) or 'empty'}"


class RenameLabel(Edit):
    """Give a label of the vocabulary another name, wherever it is used."""

    kind: Literal["rename-label"] = "rename-label"
    touches = tuple(file for file in list_files() if file.words)
    title = "{old} renamed {new}"
    old: str
    new: str

    def apply(self, project: Project) -> None:
        project.rename_label(self.old, self.new)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        return list_renamed_files(project)


class SetUp(Edit):
    """Set the axis that points up in views and pictures of assets whose format does not say."""

    kind: Literal["up"] = "up"
    touches = (Layout.settings,)
    title = "{up} points up"
    up: Literal["Y", "Z"]

    def apply(self, project: Project) -> None:
        project.set_up(self.up)


Vector = tuple[float, float, float]


class _PreparationEdit(Edit):
    touches = tuple(file for file in list_files() if file.hulls)
    asset: str


class CutHull(_PreparationEdit):
    """Cut a hull along a plane through `at` [m] across `across`, in the frame that the asset comes in."""

    kind: Literal["cut"] = "cut"
    title = "{hull} of {asset} cut in two"
    hull: str
    at: Vector
    across: Vector

    def apply(self, project: Project) -> None:
        project.cut(self.asset, self.hull, self.at, self.across)


class Unprepare(_PreparationEdit):
    """Take back the last thing that was done to an asset before the program."""

    kind: Literal["unprepare"] = "unprepare"
    title = "last preparation of {asset} taken back"

    def apply(self, project: Project) -> None:
        project.unprepare(self.asset)


class DismissSpanning(Edit):
    """Say of hulls, given by name for each asset, that they span no parts: they are not found again."""

    kind: Literal["dismiss-spanning"] = "dismiss-spanning"
    touches = (Layout.preparation_plan,)
    hulls: dict[str, tuple[str, ...]]

    def apply(self, project: Project) -> None:
        project.dismiss_spanning(self.hulls)

    def describe(self, project: Project) -> str:
        return f"{pluralize(sum(map(len, self.hulls.values())), 'hull')} left as found"


class ReviewAssets(Edit):
    """Accept the results of some assets, or call them wrong; null takes that back.

    selections, labels: where the result of one asset is wrong, the hulls that rules should have selected, and labels
    that hulls should have; goals: texts of those that fail on an accepted result, and do not count there.
    """

    kind: Literal["review"] = "review"
    touches = (Layout.events,)
    ids: tuple[str, ...]
    verdict: Literal["accepted", "wrong"] | None
    note: str | None = None
    selections: dict[int, tuple[str, ...]] = Field(default_factory=dict)
    labels: dict[str, str] = Field(default_factory=dict)
    goals: tuple[str, ...] = ()

    def apply(self, project: Project) -> None:
        project.set_verdict(
            self.ids, self.verdict, self.note, selections=self.selections, labels=self.labels, goals=self.goals
        )

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        labels = map(project.layout.labels, self.ids if self.labels else ())
        return (*super().list_paths(project), *labels)

    def describe(self, project: Project) -> str:
        return f"{_count_or_name(self.ids)} {self.verdict or 'not reviewed'}"


class ExcludeAssets(Edit):
    """Give some assets up, with the reason; null includes them again."""

    kind: Literal["exclude"] = "exclude"
    touches = (Layout.events, Layout.settings)
    ids: tuple[str, ...]
    reason: ExclusionReason | None

    def apply(self, project: Project) -> None:
        project.exclude(self.ids, self.reason)

    def describe(self, project: Project) -> str:
        return f"{_count_or_name(self.ids)} {f'excluded: {self.reason}' if self.reason else 'included again'}"


class _ManualEditBase(Edit):
    touches = (Layout.manual_edits, Layout.events)
    asset: str


class CorrectByHand(_ManualEditBase):
    """Add an edit by hand, on hulls by the names they have after the program and the edits before."""

    kind: Literal["correct"] = "correct"
    select: tuple[str, ...]
    action: ActionCall

    def apply(self, project: Project) -> None:
        project.correct(self.asset, self.select, *read_action(self.action, self.asset))

    def describe(self, project: Project) -> str:
        return f"{self.asset} edited by hand: {action_text(*read_action(self.action, self.asset))}"


class DropManualEdits(_ManualEditBase):
    """Take all edits by hand away from an asset, so that it is what the program makes of it."""

    kind: Literal["drop-manual-edits"] = "drop-manual-edits"
    title = "edits by hand of {asset} taken away"

    def apply(self, project: Project) -> None:
        project.write_manual_edits(self.asset, ())


def _count_or_name(ids: tuple[str, ...]) -> str:
    return ids[0] if len(ids) == 1 else pluralize(len(ids), "asset")


class AddAssets(Edit):
    """Take uploaded files into the project. staged: the folder they lie in; files: their paths there; added: those of
    them that are assets, the others being their parts; home: the folder they come to."""

    staged: str
    files: tuple[str, ...]
    added: tuple[str, ...]
    home: str

    def apply(self, project: Project) -> None:
        home = Path(self.home)
        for name in self.files:
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(self.staged) / name).replace(home / name)
        project.add_assets([home / name for name in self.added])

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        layout = project.layout
        return (layout.settings, layout.events, *(Path(self.home) / name for name in self.files))

    def describe(self, project: Project) -> str:
        return f"{pluralize(len(self.added), 'asset')} added: {join_names(self.added, most=2)}"
