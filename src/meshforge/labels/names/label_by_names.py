"""Labels for the hulls of a project from names of hulls, bodies, meshes and materials, by words or by patterns."""

import re
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fnmatch import translate
from pathlib import Path
from typing import Literal

from meshforge.batch import SETTINGS
from meshforge.common import MeshForgeError, UsageError, suggest_name
from meshforge.labels.labeler import NO_REASON, AssetLabels, Labeler, LabelFamily, LabelProposal, LabelReason
from meshforge.labels.merge import can_fill_gap
from meshforge.labels.names.words import UNSURE, match_label
from meshforge.store import AssetFacts, Settings
from meshforge.symbolic import Label, Mentions, SymbolicMesh

MatchKind = Literal["pattern", "word", "synonym", "likeness"]

NAMELESS = "body"
"""What formats without bodies call the only one."""
_PATTERN = 0.9
_SURE = 0.5  # a name that is less sure gives way to the next
_LESS = {"body": 0.1, "class": 0.1, "shown": 0.1, "material": 0.2}  # what a name says of several things at once
_HULL, _LABEL = "hull", "label"
_OWN = ("visual", "mesh", "group", "node")
_DIGITS = 2


@dataclass(frozen=True, slots=True)
class NamePattern:
    """text: a glob `*drawer*` for whole names, or `/^d\\d+$/` for a part of one; cases are not told apart.

    label: what such names mean, empty for what is to be left without a label.
    """

    text: str
    label: str
    expression: re.Pattern[str]

    def matches(self, name: str) -> bool:
        return self.expression.search(name) is not None


def pattern_of(text: str, label: str) -> NamePattern:
    """Return a pattern. Raises UsageError for a regular expression that is none."""
    is_expression = len(text) > 1 and text.startswith("/") and text.endswith("/")
    try:
        expression = re.compile(text[1:-1] if is_expression else rf"\A{translate(text)}", re.IGNORECASE)
    except re.error as error:
        raise UsageError(f"the pattern {text} is no regular expression: {error}", remedy="Correct it.") from None
    return NamePattern(text, label, expression)


def find_pattern(name: str, patterns: Iterable[NamePattern]) -> NamePattern | None:
    """Return the first pattern that fits a name."""
    return next((pattern for pattern in patterns if pattern.matches(name)), None)


@dataclass(frozen=True, slots=True)
class HullNames:
    """The names of a hull: its own, that of its body, and what else its file calls it."""

    hull: str
    body: str
    mentions: Mentions = ()

    @property
    def own(self) -> str:
        """Its name without that of its body."""
        return self.hull.removeprefix(f"{self.body}/")

    def all_names(self) -> Iterator[tuple[str, str]]:
        """Yield the kinds and the names, what is most its own first; a body that has no real name is left out."""
        yield from ((kind, name) for kind, name in self.mentions if kind == _LABEL)
        yield _HULL, self.own
        yield from ((kind, name) for kind, name in self.mentions if kind in _OWN)
        if self.body != NAMELESS:
            yield "body", self.body
        yield from ((kind, name) for kind, name in self.mentions if kind not in (*_OWN, _LABEL))


@dataclass(frozen=True, slots=True)
class NameMatch:
    """What names say: a label, None for a hull that a pattern leaves without one; how sure, and by which name of what
    kind (`hull`, `body`, or one of `Mentions`)."""

    label: str | None
    confidence: float
    kind: str
    name: str
    how: MatchKind

    @property
    def is_unsure(self) -> bool:
        """Whether the name may as well mean another thing."""
        return self.confidence < _SURE


def match_names(names: HullNames, vocabulary: Sequence[str], patterns: Sequence[NamePattern] = ()) -> NameMatch | None:
    """Return what the names of a hull say, None where they say nothing.

    Patterns come first, then words; each name of the hull is asked in turn, its own first.
    """
    for kind, name in (*names.all_names(), (_HULL, names.hull)):
        if pattern := find_pattern(name, patterns):
            return NameMatch(pattern.label or None, _PATTERN, kind, name, "pattern")
    return _match_words(names, vocabulary)


def _match_words(names: HullNames, vocabulary: Sequence[str]) -> NameMatch | None:
    """What the first name says that is sure of it, else the one that is surest.

    It is unsure after all where another name of the hull's own is as sure of another label.
    """
    found = list(_match_each_name(names, vocabulary))
    sure = [one for one in found if one.confidence >= _SURE]
    if not sure:
        return max(found, key=lambda one: one.confidence, default=None)
    own = {one.label for one in sure if one.kind in (_HULL, _LABEL, *_OWN)}
    return replace(sure[0], confidence=UNSURE) if len(own) > 1 else sure[0]


def _match_each_name(names: HullNames, vocabulary: Sequence[str]) -> Iterator[NameMatch]:
    for kind, name in names.all_names():
        if one := match_label(name, vocabulary):
            confidence = round(one.confidence - _LESS.get(kind, 0.0), _DIGITS)
            yield NameMatch(one.label, confidence, kind, name, one.how)


PatternPairs = Sequence[tuple[str, str]]
"""Patterns of names, each with the label that such names mean, empty for none; the first that fits counts."""


def name_patterns(
    folder: Path, settings: Settings, vocabulary: Sequence[str], more: PatternPairs = ()
) -> tuple[NamePattern, ...]:
    """Return the patterns of the project in a folder; more: others, which come first.

    Raises UsageError: a label that is not in the vocabulary, or a regular expression that is none.
    """
    where = str(folder / SETTINGS)
    given = tuple(_check_pattern(text, label, vocabulary) for text, label in more)
    try:
        return (*given, *(_check_pattern(text, label, vocabulary) for text, label in settings.names.items()))
    except MeshForgeError as error:
        raise error.at(where) from None


def _check_pattern(text: str, label: str, vocabulary: Sequence[str]) -> NamePattern:
    if label and label not in vocabulary:
        remedy = suggest_name(label, vocabulary, f"The vocabulary is: {', '.join(vocabulary) or 'empty'}.")
        raise UsageError(f"the pattern {text} means {label!r}, which is not in the vocabulary", remedy=remedy)
    return pattern_of(text, label)


class NameLabeler(Labeler):
    """Labels hulls without a label by their own names, those of their bodies, and what else their files call them.

    Patterns count first: `meanings`, then those of the project's settings; then the words of the vocabulary, and words
    that are nearly those. Raises ProjectError: no vocabulary; UsageError: a wrong pattern.
    """

    name = "names"
    about = "labels read off the names of hulls and bodies"

    def __init__(self, meanings: PatternPairs = ()) -> None:
        self.meanings = tuple(meanings)

    def propose(self, family: LabelFamily) -> LabelProposal:
        words, store = family.require_vocabulary(), family.store
        patterns = name_patterns(store.folder, store.settings, words, self.meanings)
        return LabelProposal(_label_assets(family, patterns))

    def can_replace(self, current: Label | None, given: Label | None) -> bool:
        return can_fill_gap(current, given)


def _label_assets(family: LabelFamily, patterns: Sequence[NamePattern]) -> Generator[AssetLabels, None, None]:
    for asset, facts in family.iterate_facts():
        found = {
            names.hull: (names, match_names(names, family.vocabulary, patterns)) for names in names_of_facts(facts)
        }
        given = {hull: label for hull, (_, one) in found.items() if one and (label := to_label(one))}
        reasons = {hull: _reason_of(names, one) for hull, (names, one) in found.items()}
        yield AssetLabels(asset, facts.hulls, given, reasons, error=facts.error)


def _reason_of(names: HullNames, one: NameMatch | None) -> LabelReason:
    if one is None:
        return NO_REASON, names.own
    return one.kind + {"pattern": " by pattern", "likeness": " nearly", "synonym": " by synonym", "word": ""}[
        one.how
    ], one.name


def to_label(one: NameMatch) -> Label | None:
    """Return the label that names say, None where a pattern leaves the hull without one."""
    return Label(one.label, one.confidence, "name") if one.label else None


def names_of_mesh(mesh: SymbolicMesh) -> Iterator[HullNames]:
    """Return the names of each hull of a mesh."""
    mentions = {geom.name: geom.mentions for geom in mesh.asset.geoms} if mesh.asset else {}
    return (HullNames(hull.name, hull.body, mentions.get(hull.name, ())) for hull in mesh.hulls)


def names_of_facts(facts: AssetFacts) -> Iterator[HullNames]:
    """Return the names of each hull of an asset, from its facts."""
    return map(HullNames, facts.hulls, facts.bodies, facts.mentions)
