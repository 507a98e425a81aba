"""Bodies rebuilt of which a hull spans parts: found asset by asset, each in a worker process and compared with the
labelled assets of the project alone, so that what is found of one does not depend on the others."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import asdict, dataclass, replace
from functools import partial
from glob import escape

from meshforge import batch
from meshforge.batch.preparation.decompose import matches_only
from meshforge.common import ProjectError, UsageError, describe_error, join_names
from meshforge.formats import read
from meshforge.labels import HullSpan, ReferenceFamily, SpanReport, read_reference_family
from meshforge.labels.labeler import Stage, ignore_stage
from meshforge.project.preparation_plan import REBUILD_DEFAULTS, RebuildSettings, keep_rebuilt, read_dismissed
from meshforge.project.prepare import PreparationResult, keep_preparation
from meshforge.store import Store
from meshforge.store.meshes import AssetFiles
from meshforge.symbolic import Asset, Label, SymbolicMesh

LIKELY = 0.5
"""The probability from which a hull is named."""
MADE_ANEW = "made anew with its body"
"""Why a hull is replaced that spans no parts itself."""
MOST_SHOWN = 0.99
"""What is shown of the confidence of a label that follows from others, at most: 100% reads as certain."""
_NAMED = 3  # hulls that a note names
_DIGITS = 3


def rebuild_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    how: RebuildSettings = REBUILD_DEFAULTS,
    *,
    bodies: Mapping[str, Collection[str]] | None = None,
    dry_run: bool = False,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Stage = ignore_stage,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
) -> Iterator[PreparationResult]:
    """Make all hulls of a body anew, each of one part and with its label, where one of them spans parts with a
    probability of at least `how.min_confidence`.

    Each asset gets one step, which `unprepare` takes back with labels and selections. assets: which may be rebuilt, all
    when None; bodies: which of theirs, by asset, in place of `assets`. Hulls that were dismissed are left out.
    dry_run: nothing is written; `planned` is what would be done. `notes` name hulls that were left. write_block: the
    block in which an asset's files are written.
    Raises UsageError for a probability that is none, ProjectError where no hull has a label.
    """
    if not 0 < how.min_confidence <= 1:
        raise UsageError(f"--min-confidence {how.min_confidence:g}: a probability is needed, above 0 and at most 1")
    if bodies is not None:
        assets = [asset for asset, names in bodies.items() if names]
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    family = read_reference_family(store, execution, stage, how.pieces)
    if family is None:
        remedy = "Label the hulls of one or two assets first: meshforge label, or the studio."
        problem = "no hull has a label, so nothing says what parts there are"
        raise ProjectError(problem, where=str(store.folder), remedy=remedy)
    hows = [replace(how, only=tuple(map(escape, bodies[asset]))) if bodies else how for asset in ids]
    dismissed = read_dismissed(store)
    work = [
        (asset, files, own, frozenset(dismissed.get(asset, ())))
        for asset, files, own in zip(ids, store.asset_files(ids), hows, strict=True)
    ]
    with stage(len(work), "looking for hulls that span parts") as advance:
        found = batch.execute(partial(_search, family), work, replace(execution, progress=advance))
        for asset, one in zip(ids, found, strict=True):
            if isinstance(one, batch.WorkerFailure | str):
                problem = one if isinstance(one, str) else one.why
                yield PreparationResult(asset, problems=(problem,))
            elif dry_run or not one.rebuild.bodies:
                planned = one.rebuild.after.steps[-1].replaced if one.rebuild.bodies else ()
                yield PreparationResult(asset, notes=one.notes, planned=planned, found=one.rebuild.spans)
            else:
                after, words = one.rebuild.after, store.vocabulary
                labels = {name: label for name, label in one.rebuild.labels.items() if label.name in words}
                with write_block(asset):
                    kept = keep_preparation(store, asset, after, one.seen, after.steps[-1].replaced, labels)
                notes = (*kept.notes, *(() if kept.problems else one.notes))
                yield replace(kept, notes=notes, found=one.rebuild.spans)
    if not dry_run and bodies is None:
        keep_rebuilt(store, ids, how)


@dataclass(frozen=True, eq=False, slots=True)
class _SearchResult:
    """What was found of an asset. seen: the digest of the preparation that it had."""

    rebuild: "Rebuild"
    notes: tuple[str, ...]
    seen: str | None


def _search(
    family: ReferenceFamily, work: tuple[str, AssetFiles, RebuildSettings, frozenset[str]]
) -> _SearchResult | str:
    asset, files, how, dismissed = work
    try:
        seen = batch.record_digest(files.preparation)
        before = batch.read_preparation(files.preparation) or batch.Preparation()
        source, mesh = read(files.path), files.read_mesh()
        found = plan_rebuild(family.without(asset), source, before, mesh, how, dismissed)
        matches = any(_matches(hull.name, hull.body, how) for hull in mesh.hulls)
        missed = [] if matches else [f"no hull or body matches {join_names(how.only)}"]
        return _SearchResult(found, (*found.notes, *missed, *found.describe_left(how.min_confidence)), seen)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(files.path))


@dataclass(frozen=True, eq=False, slots=True)
class RebuiltBody:
    """A body that is made anew. spans: its hulls that span parts; labels: of its new hulls, by name."""

    body: str
    spans: tuple[HullSpan, ...]
    labels: Mapping[str, Label]

    @property
    def chance(self) -> float:
        """The probability that it has a hull which spans parts, that of the surest one."""
        return max(span.chance for span in self.spans)

    def __str__(self) -> str:
        """`base/h0 holds wall and handle, 94%: base rebuilt into wall (99%), 2 handle (97% to 98%)`."""
        return f"{'; '.join(map(str, self.spans))}: {self.body} rebuilt into {describe_labels(self.labels.values())}"


@dataclass(frozen=True, eq=False, slots=True)
class Rebuild:
    """What is to be done to an asset. after: its preparation with that; bodies: those that are rebuilt; left: hulls
    that likely span parts and stay as they are; notes: on what could not be judged."""

    after: batch.Preparation
    bodies: tuple[RebuiltBody, ...] = ()
    left: tuple[HullSpan, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def spans(self) -> tuple[HullSpan, ...]:
        """The hulls that span parts, of all bodies that are made anew."""
        return tuple(span for one in self.bodies for span in one.spans)

    @property
    def labels(self) -> dict[str, Label]:
        """The labels of all new hulls, by name."""
        return {name: label for one in self.bodies for name, label in one.labels.items()}

    def describe_left(self, min_confidence: float) -> Iterator[str]:
        """Yield a sentence on hulls that stay as they are though they likely span parts."""
        below = [str(span) for span in self.left if span.chance < min_confidence]
        if below:
            more = f"; and {len(below) - _NAMED} more" if len(below) > _NAMED else ""
            yield f"below {min_confidence:.0%}, left as they are: {'; '.join(below[:_NAMED])}{more}"
        for span in (one for one in self.left if one.chance >= min_confidence):
            yield f"{span}: no half of any piece of the surface is in its body; cut it by hand: meshforge cut"


def plan_rebuild(
    family: ReferenceFamily,
    source: Asset,
    before: batch.Preparation,
    mesh: SymbolicMesh,
    how: RebuildSettings,
    dismissed: frozenset[str] = frozenset(),
) -> Rebuild:
    """Return how bodies of an asset are made anew. source: the asset as it was read; before: what is prepared already;
    mesh: it as it is prepared, with its labels; dismissed: names of hulls that a person said span no parts."""
    report = family.find_spans(source, mesh)
    notes, likely = tuple(report.notes), _find_likely(report, before, how, dismissed)
    spans = {span.hull: span for span in likely if span.chance >= how.min_confidence}
    bodies = dict.fromkeys(span.body for span in spans.values())
    made = {body: rows for body in bodies if (rows := report.rebuild(body))}
    left = tuple(span for span in likely if span.body not in made)
    if not made:
        return Rebuild(before, left=left, notes=notes)
    rows = {hull: own for body in made.values() for hull, own in body.items()}
    parts = (
        batch.HullParts(hull, tuple(one.shape for one in own), str(spans.get(hull, MADE_ANEW)))
        for hull, own in rows.items()
    )
    chances = {hull: span.chance for hull, span in spans.items()}
    settings = {**asdict(how), "only": list(how.only), "rebuilt": list(made), "chances": chances}
    after = batch.replace_hulls(source, before, tuple(parts), settings)
    labels = {
        entry.what: {
            name: Label(one.label, round(one.share, _DIGITS), "rebuild")
            for name, one in zip(entry.made, rows[entry.what], strict=True)
        }
        for entry in after.steps[-1].replaced
    }
    rebuilt = (
        RebuiltBody(
            body,
            tuple(span for span in spans.values() if span.body == body),
            {name: label for hull in own for name, label in labels[hull].items()},
        )
        for body, own in made.items()
    )
    return Rebuild(after, tuple(rebuilt), left, notes)


def _find_likely(
    report: SpanReport, before: batch.Preparation, how: RebuildSettings, dismissed: frozenset[str]
) -> list[HullSpan]:
    """The hulls that likely span parts, but for those that a person dismissed, and those that a rebuild made: another
    would make no better ones."""
    steps = (step for step in before.steps if "rebuilt" in step.settings)
    anew = {name for step in steps for entry in step.replaced for name in entry.made}
    least = min(LIKELY, how.min_confidence)
    likely = (span for span in report.spans if span.chance >= least and span.hull not in anew | dismissed)
    return [span for span in likely if _matches(span.hull, span.body, how)]


def _matches(hull: str, body: str, how: RebuildSettings) -> bool:
    return any(matches_only(name, how.only) for name in (hull, body))


def describe_labels(labels: Iterable[Label]) -> str:
    """Return how many hulls have which label, and how sure these are: `10 wall (75% to 92%), handle (93%)`."""
    confidences = dict[str, list[float]]()
    for label in labels:
        confidences.setdefault(label.name, []).append(min(label.confidence, MOST_SHOWN))
    rows = (
        (name, own, dict.fromkeys(f"{one:.0%}" for one in (min(own), max(own)))) for name, own in confidences.items()
    )
    return ", ".join(
        f"{f'{len(own)} ' if len(own) > 1 else ''}{name} ({' to '.join(ends)})" for name, own, ends in rows
    )
