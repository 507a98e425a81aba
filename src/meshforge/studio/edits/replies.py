"""The one edit that a reply to a question is, whatever its kind."""

from collections import Counter
from functools import cached_property
from pathlib import Path
from typing import Literal, assert_never

from pydantic import Field

from meshforge.common import pluralize
from meshforge.project import Project, has_agreed_labels
from meshforge.signoff import HullPlace, ReviewChoice, ReviewQuestion, ReviewReply, question_of
from meshforge.signoff.question import NO
from meshforge.store import Layout
from meshforge.studio.edits.base import Edit, LabelsByAsset
from meshforge.studio.wire.family import ReviewQuestionView
from meshforge.studio.wire.requests import HullOfAsset


class HullLabel(HullOfAsset):
    """A hull and the label that it gets."""

    label: str


class ReplyToQuestion(Edit):
    """Reply to a question. question: as it was asked; choice: the id of one of its choices, null for none of them.

    exceptions: hulls of a group that are something else, or all that are labelled where none of the choices fits;
    selections, labels: where a result is wrong, the hulls that rules should have selected, by their numbers, and labels
    that hulls should have; later: the question is snoozed.
    """

    kind: Literal["reply"] = "reply"
    touches = (Layout.events, Layout.settings)
    question: ReviewQuestionView
    choice: str | None = None
    exceptions: tuple[HullLabel, ...] = ()
    selections: dict[int, tuple[str, ...]] = Field(default_factory=dict)
    labels: dict[str, str] = Field(default_factory=dict)
    later: bool = False

    def apply(self, project: Project) -> None:
        project.reply(self._asked, self._reply)

    def list_paths(self, project: Project) -> tuple[Path, ...]:
        layout, assets = project.layout, self.list_labels()
        everywhere = bool(assets) and has_agreed_labels(project)
        labels = [Layout.labels.path(project.folder)] if everywhere else map(layout.labels, assets)
        return (*super().list_paths(project), layout.demonstration(self._asked.asset), *labels)

    def list_labels(self) -> LabelsByAsset:
        labels: dict[str, dict[str, str | None]] = {}
        for (asset, hull), label in self._labels.items():
            labels.setdefault(asset, {})[hull] = label
        return labels

    def describe(self, project: Project) -> str:
        if self._is_put_off:
            return "question snoozed" if self.later else "question left open"
        question, choice, asset = self._asked, self._choice, self._asked.asset
        match question.kind:
            case "candidate" | "label":
                return f"rule {question.rule} on {asset} answered"
            case "selection" if not self._labels:
                return f"what rule {question.rule} selects on {asset} corrected"
            case "group" | "repair" | "selection":
                counts = Counter(self._labels.values()).items()
                return ", ".join(f"{pluralize(count, 'hull')} labelled {label}" for label, count in counts)
            case "result":
                return f"result of {asset}: {choice.text if choice else 'none'}"
            case "orientation":
                return "assets are turned first"
            case "demonstrate":
                return "question snoozed"
            case _:
                assert_never(question.kind)

    @cached_property
    def _asked(self) -> ReviewQuestion:
        asked = question_of(self.question.model_dump())
        assert asked, "the page sends what it was asked"
        return asked

    @property
    def _reply(self) -> ReviewReply:
        return ReviewReply(
            self.question.id,
            self.choice,
            {HullPlace(one.asset, one.hull): one.label for one in self.exceptions},
            {rule: frozenset(hulls) for rule, hulls in self.selections.items()},
            self.labels,
            self.later,
        )

    @property
    def _choice(self) -> ReviewChoice | None:
        return self._asked.choice(self.choice)

    @property
    def _labels(self) -> dict[HullPlace, str]:
        if self.later:
            return {}
        asked, choice = self._asked, self._choice
        given = dict.fromkeys(asked.hulls, choice.label) if choice and choice.label else {}
        own_labels = {HullPlace(asked.asset, hull): label for hull, label in self.labels.items()}
        return {place: label for place, label in {**given, **self._reply.exceptions, **own_labels}.items() if label}

    @property
    def _is_put_off(self) -> bool:
        if self.later or self._asked.kind == "demonstrate":
            return True
        if self._asked.kind in ("selection", "orientation"):
            return self.choice is None or self.choice == NO
        return self.choice is None and not self._labels and self._asked.kind not in ("candidate", "label")
