"""What a file says of the hulls of an asset, and what the names in it mean in the vocabulary of a project."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from meshforge.common import pluralize, suggest_match
from meshforge.labels.names.label_by_names import NamePattern, find_pattern
from meshforge.labels.names.words import match_label
from meshforge.symbolic import Label

_DIGITS = 3


@dataclass(frozen=True, slots=True)
class FileLabels:
    """labels, names: by hull, its label and what the file itself calls it; problems: a sentence on each left out."""

    labels: Mapping[str, Label] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    problems: Sequence[str] = ()


Meaning = tuple[str | None, float] | None
"""What a name means: a label, None for a hull that is to be left without one, and how surely; None: nothing."""


def meaning_of(name: str, vocabulary: Sequence[str], patterns: Sequence[NamePattern]) -> Meaning:
    """Return what a name means: by a pattern, else the label of its name, else the one whose words are in it.

    `rotation_door` means `door`; words that are only nearly those of a label do not count.
    """
    if pattern := find_pattern(name, patterns):
        return pattern.label or None, 1.0
    if name in vocabulary:
        return name, 1.0
    one = match_label(name, vocabulary)
    return (one.label, one.confidence) if one and one.how == "word" else None


def to_file_labels(found_names: Mapping[str, tuple[str, Meaning, float]], vocabulary: Sequence[str]) -> FileLabels:
    """Return the labels that are said of hulls; by hull, its name in the file, what that means, and a confidence."""
    labels, unknown = dict[str, Label](), Counter[str]()
    for hull, (name, meaning, confidence) in found_names.items():
        if meaning is None:
            unknown[name] += 1
        elif meaning[0]:
            labels[hull] = Label(meaning[0], round(confidence * meaning[1], _DIGITS), "file")
    problems = [
        f"{pluralize(count, 'hull')} left out: {name!r} is not in the vocabulary, and no pattern says what it means"
        f"{suggest_match(name, vocabulary)}"
        for name, count in unknown.items()
    ]
    return FileLabels(labels, {hull: name for hull, (name, _, _) in found_names.items()}, problems)
