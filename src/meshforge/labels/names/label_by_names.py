"""Labels for the hulls of a project from names: hulls, bodies, meshes and materials are often called what they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from meshforge.batch import SETTINGS, ExecutionOptions
from meshforge.common import MeshForgeError, ProjectError, UsageError, nearest_name
from meshforge.labels.merge import LabelOutcome, LabelWriter, OutcomeCallback, can_fill_gap
from meshforge.labels.names.hull_names import HullNames, NameMatch, NamePattern, match_names, pattern_of
from meshforge.labels.propose import LabelEvidence, Proposals, group_evidence
from meshforge.store import AssetFacts, Settings, Store, iterate_survey
from meshforge.symbolic import Label, SymbolicMesh, match_labels

PatternPairs = Sequence[tuple[str, str]]
"""Patterns of names, each with the label that such names mean, empty for none; the first that fits counts."""


def name_patterns(
    folder: Path, settings: Settings, vocabulary: Sequence[str], more: PatternPairs = ()
) -> tuple[NamePattern, ...]:
    """The patterns of the project in a folder; more: others, which come first.

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
        like = nearest_name(label, vocabulary)
        remedy = f"Did you mean {like!r}?" if like else f"The vocabulary is: {', '.join(vocabulary) or 'empty'}."
        raise UsageError(f"the pattern {text} means {label!r}, which is not in the vocabulary", remedy=remedy)
    return pattern_of(text, label)


def label_from_names(
    store: Store, meanings: PatternPairs, execution: ExecutionOptions, report: OutcomeCallback
) -> tuple[LabelOutcome, ...]:
    """Give hulls without a label the one that their names say; see `LabelStore.label_from_names`."""
    patterns = require_patterns(store, store.vocabulary, meanings)
    writer, reports = LabelWriter(store), list[LabelOutcome]()
    for asset, facts in iterate_survey(store.found, store.layout, execution=execution):
        reports.append(_label_asset(writer, asset, facts, patterns))
        report(reports[-1])
    return tuple(reports)


def require_patterns(store: Store, vocabulary: Sequence[str], meanings: PatternPairs) -> tuple[NamePattern, ...]:
    """The patterns that say what names mean. Raises ProjectError: no vocabulary; UsageError: a wrong pattern."""
    if not vocabulary:
        remedy = "Say first what hulls can be."
        raise ProjectError("the vocabulary is empty", where=str(store.folder), remedy=remedy)
    return name_patterns(store.folder, store.settings, vocabulary, meanings)


def _label_asset(writer: LabelWriter, asset: str, facts: AssetFacts, patterns: Sequence[NamePattern]) -> LabelOutcome:
    if facts.error:
        return LabelOutcome(asset, problems=(facts.error,))
    matches = ((names.hull, match_names(names, writer.vocabulary, patterns)) for names in names_of_facts(facts))
    given = {hull: label for hull, one in matches if one and (label := to_label(one))}
    return writer.try_write(asset, facts.hulls, given, can_fill_gap)


def to_label(one: NameMatch) -> Label | None:
    """The label that names say, None where a pattern leaves the hull without one."""
    return Label(one.label, one.confidence, "name") if one.label else None


def names_of_mesh(mesh: SymbolicMesh) -> Iterator[HullNames]:
    """The names of each hull of a mesh."""
    mentions = {geom.name: geom.mentions for geom in mesh.asset.geoms} if mesh.asset else {}
    return (HullNames(hull.name, hull.body, mentions.get(hull.name, ())) for hull in mesh.hulls)


def names_of_facts(facts: AssetFacts) -> Iterator[HullNames]:
    """The names of each hull of an asset, from its facts."""
    return map(HullNames, facts.hulls, facts.bodies, facts.mentions)


def propose_from_names(
    store: Store, meanings: PatternPairs, vocabulary: Sequence[str] | None, execution: ExecutionOptions
) -> Proposals:
    """What names would give, by the survey alone, with nothing written."""
    words = store.vocabulary if vocabulary is None else tuple(vocabulary)
    patterns = require_patterns(store, words, meanings)
    found, problems, labelled = list[LabelEvidence](), list[str](), 0
    for asset, facts in iterate_survey(store.found, store.layout, execution=execution):
        try:
            present = match_labels(store.labels(asset), facts.hulls).labels
        except MeshForgeError as error:
            problems.append(f"{asset}: {error.message}")
            continue
        problems += [f"{asset}: {facts.error}"] if facts.error else []
        labelled += len(present)
        found += [
            _evidence_of(asset, names, match_names(names, words, patterns))
            for names in names_of_facts(facts)
            if names.hull not in present
        ]
    return group_evidence(found, words, labelled, problems)


def _evidence_of(asset: str, names: HullNames, one: NameMatch | None) -> LabelEvidence:
    if one is None:
        return LabelEvidence(asset, None, "nothing said", names.own)
    suffix = {"pattern": " by pattern", "likeness": " nearly", "word": ""}[one.how]
    return LabelEvidence(asset, to_label(one), one.kind + suffix, one.name)
