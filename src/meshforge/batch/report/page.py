"""The report: one HTML file that holds everything it shows. What `page.html.j2` says is worked out here."""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple, Self, get_args

from meshforge.batch.execution import execute
from meshforge.batch.report import contents
from meshforge.batch.workers import IN_PROCESS, ExecutionOptions, WorkerFailure
from meshforge.checks import Finding
from meshforge.common import join_names, pluralize, write_atomically
from meshforge.language import Program, Rule, explain, show, show_label
from meshforge.rendering import DIFFERENCE_COLORS, UNLABELLED, label_colors, look_of
from meshforge.symbolic import find_unchanged

MOST_PICTURED = 120
"""Assets with pictures by default: about 60 kB each in the page."""
_SETTINGS = {
    "picture_size": contents.PICTURE_SIZE,
    "check_size": contents.CHECK_PICTURE_SIZE,
    "names_shown": 60,  # of hulls in one cell of the table; the rest is counted
    "notes_shown": 6,  # at once
    "findings_shown": 40,  # of one asset, errors first
}
_UNPRINTABLE = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")
"""Characters that no document can hold."""


@dataclass(frozen=True, slots=True)
class ReportHeader:
    """What stands at the top of a report.

    about: a line below the title; seconds: that the run took; figures: of the whole run, of which the assets shown may
    be some; without them, they are those of the assets shown. standing: how sure the results are, in lines.
    """

    title: str
    about: str | None = None
    seconds: float | None = None
    figures: contents.RunFigures | None = None
    result_status: str | None = None


@dataclass(frozen=True, slots=True)
class ReportOptions:
    """What a report shows of its assets.

    pictured: how many assets get pictures, demonstrated and failed ones first; progress: called for each asset;
    execution: where pictures are drawn, by default here, one after the other.
    """

    pictured: int = MOST_PICTURED
    progress: Callable[[], None] | None = None
    execution: ExecutionOptions = IN_PROCESS


REPORT_DEFAULTS = ReportOptions()


def write_report(
    path: Path,
    header: ReportHeader,
    assets: Sequence[contents.ReportAsset],
    *,
    program: Program | None = None,
    options: ReportOptions = REPORT_DEFAULTS,
) -> None:
    """Write the report of a batch: figures, the program if one ran, and every asset, with what each rule did.

    Of a project, assets that need review or failed come first, the least sure before others. Elsewhere those that
    failed come first, then those with findings, where assets were checked. The page refers to no other file. Raises
    StoppedError where `options.execution.stop` says so.
    """
    from meshforge.signoff import ResultStatusWord  # lazy: 0.02 s, which only pages take

    words: tuple[ResultStatusWord, ...] = get_args(ResultStatusWord)
    statuses: tuple[contents.ReportStatus, ...] = get_args(contents.ReportStatus)
    if any(asset.result_status for asset in assets):
        assets = sorted(assets, key=lambda asset: asset.rank)
    elif any(asset.checked for asset in assets):
        assets = sorted(assets, key=lambda asset: (not asset.is_broken, not asset.findings))
    meshes = [mesh for asset in assets for mesh in (asset.before, asset.after) if mesh]
    known = program.labels if program else ()
    labels = (*known, *sorted({hull.label for mesh in meshes for hull in mesh.hulls if hull.label} - set(known)))
    labelled = any(hull.label for mesh in meshes for hull in mesh.hulls)
    colors, pictures = label_colors(labels), contents.PictureOptions(labels, labelled)
    order = sorted(range(len(assets)), key=lambda k: not (assets[k].demonstrated or assets[k].needs_review))
    chosen = frozenset(order[: options.pictured])
    cards: list[tuple[contents.ReportAsset, contents.AssetPictures | None]] = []
    drawing = execute(
        partial(contents.draw_asset, options=pictures), [assets[k] for k in sorted(chosen)], options.execution
    )
    for k, asset in enumerate(assets):
        made = next(drawing) if k in chosen else None
        cards.append((asset, None if isinstance(made, WorkerFailure) else made))
        if options.progress:
            options.progress()
    drawn = [shown for _, shown in cards if shown]
    figures = header.figures or contents.RunFigures.of_assets(assets)
    figures = replace(figures, more={**figures.more, **contents.sum_speeds(assets)})
    page = _load_template().render(
        **_SETTINGS,
        header=header,
        figures=figures,
        counts=[(status, figures.counts[status]) for status in statuses if figures.counts.get(status)],
        result_statuses=[(word, n) for word in words if (n := figures.result_statuses.get(word))],
        selection=_describe_selection(len(assets), figures),
        has_program=program is not None,
        header_lines=list(_header_lines(program)) if program else [],
        rules=[_rule_row(k, rule, assets) for k, rule in enumerate(program.rules, 1)] if program else [],
        label_legend=_label_legend(assets, colors if labelled else {}),
        change_legend=_change_legend(assets) if any(shown.changes for shown in drawn) else None,
        kinds=_kinds(assets, [*statuses, *words]),
        has_pairs=any(shown.after for shown in drawn),
        cards=cards,
    )
    write_atomically(Path(path), _UNPRINTABLE.sub("\N{REPLACEMENT CHARACTER}", page) + "\n")


def _load_template() -> Any:
    from jinja2 import Environment, StrictUndefined  # lazy: 0.05 s, only reports need it

    own = files("meshforge.batch.report")
    lines = (own / "page.html.j2").read_text("utf-8").splitlines()
    template = Environment(autoescape=True, undefined=StrictUndefined).from_string("".join(map(str.strip, lines)))
    template.globals.update(
        style=(own / "page.css").read_text("utf-8"),
        script=(own / "page.js").read_text("utf-8"),
        pluralize=pluralize,
        join_names=join_names,
        format_change=contents.format_change,
        format_duration=contents.format_duration,
        describe_findings=_describe_findings,
    )
    return template


def _describe_selection(shown: int, figures: contents.RunFigures) -> str | None:
    """How many of very many assets are on the page, None where all are."""
    if shown >= figures.total:
        return None
    some = f"{shown:,} of {figures.total:,} assets are shown"
    remarkable = figures.counts.get("failed") or figures.result_statuses.get("needs review")
    return f"{some}, {figures.first} first." if remarkable else f"{some}."


def _describe_findings(found: Sequence[Finding]) -> str:
    errors = sum(finding.severity == "error" for finding in found)
    return f"{pluralize(errors, 'error')}, {pluralize(len(found) - errors, 'warning')}" if found else "no findings"


def _kinds(assets: Sequence[contents.ReportAsset], words: Sequence[str]) -> list[str]:
    present = {word for asset in assets for word in (asset.status, asset.result_status and asset.result_status.word)}
    kinds: list[str] = [word for word in words if word in present]
    if any(asset.demonstrated for asset in assets):
        kinds.append("demonstrated")
    if any(asset.findings or asset.alarms for asset in assets):
        kinds.append("doubtful")
    return kinds


class _LegendRow(NamedTuple):
    color: str | None
    name: str
    text: str

    @classmethod
    def of(cls, name: str, color: str, before: int, after: int) -> Self:
        return cls(color, name, f"{before:,}" if before == after else f"{before:,} → {after:,}")


def _label_legend(assets: Sequence[contents.ReportAsset], colors: Mapping[str, str]) -> list[_LegendRow]:
    """Each label with its colour, and its hulls before and after; empty where there is no mesh.

    colors: empty where each hull has its own.
    """
    meshes = [mesh for asset in assets for mesh in (asset.before, asset.after) if mesh]
    if not meshes:
        return []
    known = [(asset.before, asset.after) for asset in assets if asset.before and asset.after]
    before, after = (Counter(hull.label for pair in known for hull in pair[k].hulls) for k in (0, 1))
    entries = [_LegendRow.of(label, color, before[label], after[label]) for label, color in colors.items()]
    if not colors:
        entries.append(_LegendRow(None, "", "nothing is labelled: each hull has its own colour"))
    elif before[None] or after[None]:
        entries.append(_LegendRow.of("no label", UNLABELLED, before[None], after[None]))
    looks = {look_of(hull.annotation) for mesh in meshes for hull in mesh.hulls}
    marks = {"guessed": "dotted: a guessed label", "unsure": "hatched: an unsure label"}
    entries += [_LegendRow(None, "", text) for look, text in marks.items() if look in looks]
    return entries


def _change_legend(assets: Sequence[contents.ReportAsset]) -> list[_LegendRow]:
    """What the colours of the pictures of changes mean, and how many hulls are of each kind."""
    pairs = [(asset.before, asset.after) for asset in assets if asset.before and asset.after]
    kept = sum(len(find_unchanged(before, after)) for before, after in pairs)
    before, after = (sum(len(pair[k].hulls) for pair in pairs) for k in (0, 1))
    counts = (("removed", before - kept), ("made", after - kept), ("kept", kept))
    return [_LegendRow.of(word, DIFFERENCE_COLORS[word], n, n) for word, n in counts]


def _header_lines(program: Program) -> Iterator[tuple[str, str | None]]:
    if program.labels:
        yield f"labels {', '.join(map(show_label, program.labels))}", None
    if program.contact is not None:
        yield f"contact {program.contact:g}", "Hulls this near each other touch (a share of the diagonal)."
    if program.extremity is not None:
        yield f"extremity {program.extremity:g}", "Hulls this near the boundary are extreme (a share of the diagonal)."
    if program.orient:
        yield show(program.orient), explain(program.orient)


class _RuleRow(NamedTuple):
    """A rule in the program's panel. selected, made: what it did over all assets, in words."""

    text: str
    sentence: str
    comment: str
    selected: str
    made: str | None


def _rule_row(number: int, rule: Rule, assets: Sequence[contents.ReportAsset]) -> _RuleRow:
    above = [line.strip() for line in rule.comments.above if line]
    comment = " ".join([*above, *([rule.comments.beside.strip()] if rule.comments.beside else [])])
    traces = [line for asset in assets for line in asset.trace if line.rule == number]
    active = [line for line in traces if line.selected]
    selected, made = "selected nothing", None
    if active:
        hulls = pluralize(sum(len(line.selected) for line in active), "hull")
        selected = f"{hulls} on {len(active)} of {pluralize(len(traces), 'asset')}"
        made = f"{sum(len(line.made) for line in active):,} made"
    return _RuleRow(show(rule), explain(rule), comment, selected, made)
