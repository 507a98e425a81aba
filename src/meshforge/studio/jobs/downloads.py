"""Jobs that make a file for the browser: a zip of the outputs, or the report."""

import shutil
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path
from uuid import uuid4

from meshforge import batch
from meshforge.common import UsageError, pluralize
from meshforge.language import Program
from meshforge.project import build_run_report, summarize_outputs
from meshforge.studio.jobs.outputs import list_signed_off
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.session.session import Session
from meshforge.studio.transfers import to_file_name
from meshforge.studio.wire.family import Card
from meshforge.studio.wire.jobs import DownloadJob, Job, JobLine

_NOT_WHOLE = "changed since it was written"
_REMEDIES = {
    "needs review": "it needs review: look at it first",
    "failed": "the program failed on it",
    "without output": "the program was not applied to it yet",
    _NOT_WHOLE: "files of its output are gone or changed: apply the program to it again",
    "wrong": "it was called wrong",
    "excluded": "it is excluded",
    "not signed off": "it is not signed off",
}
"""Why a result is not in a zip: in a count, and of one."""

Write = Callable[[JobProgress, Path], str]
"""Writes the file, and returns what there is to say of it."""


def start_download(session: Session, request: DownloadJob) -> Job:
    """Start to make a file. Raises UsageError where there is no output that it could show or hold."""
    return _start_results(session, request.signed_only) if request.what == "results" else _start_report(session)


def _start(session: Session, name: str, title: str, total: int, write: Write) -> Job:
    target = session.downloads.path_for(uuid4().hex, name)

    def work(progress: JobProgress) -> str:
        target.parent.mkdir(parents=True)
        try:
            text = write(progress, target)
            progress.raise_if_stopped()
        except BaseException:
            shutil.rmtree(target.parent, ignore_errors=True)
            raise
        session.downloads.add(progress.job.id, target)
        return text

    return session.jobs.start("download", title, total, work, name, stays="nothing was made.")


def _nothing_written() -> UsageError:
    return UsageError("nothing is written yet", remedy="Apply the program first.")


# The results


def _start_results(session: Session, signed_only: bool) -> Job:
    written = [card for card in session.pages.cards if card.output in ("edited", "unchanged")]
    if not written:
        raise _nothing_written()
    chosen = [card.asset for card in (list_signed_off(session) if signed_only else written)]
    if not chosen:
        raise UsageError("no result is signed off yet", remedy="Accept what is right, or take all results.")

    def write(progress: JobProgress, path: Path) -> str:
        project, out = session.project, session.project.layout.edited
        with batch.hold_lock(out / batch.STATE / "lock", str(out), wait=0):  # no run changes files meanwhile
            need_review = {asset.id for asset in project.status(stop=progress.is_stopped).open_assets}
            stamps = {asset: stamp for asset in chosen if (stamp := batch.read_stamp(out, asset))}
            whole = {asset: stamp for asset, stamp in stamps.items() if stamp.is_whole(out)}
            left_out = dict(_list_left_out(session.pages.cards, whole, chosen, need_review))
            for asset, why in left_out.items():
                is_broken = why in ("failed", _NOT_WHOLE)
                progress.add_line(
                    JobLine(asset=asset, status="failed" if is_broken else "skipped", text=_REMEDIES[why])
                )
            if not whole:
                raise UsageError("no result is whole", remedy="Apply the program again.")
            text = _describe_results(session.pages.cards, whole, need_review, left_out)
            names = {name for stamp in whole.values() for name in stamp.outputs}
            names |= {batch.stamp_path(out, asset).relative_to(out).as_posix() for asset in whole}
            with progress.stage(len(names), "packing") as advance:
                options = batch.ExecutionOptions(stop=progress.is_stopped, progress=advance)
                batch.write_archive(path, out, names, f"MeshForge, {project.name}: {text}", options)
        return text

    title = f"Packing {pluralize(len(chosen), 'result')}"
    return _start(session, f"{to_file_name(session.project.name, 'results')}.zip", title, len(chosen), write)


def _list_left_out(
    cards: Sequence[Card], inside: Collection[str], chosen: Collection[str], need_review: Collection[str]
) -> Iterator[tuple[str, str]]:
    for card in cards:
        if card.asset in inside:
            continue
        if card.output == "failed":
            yield card.asset, "failed"
        elif card.output == "none":
            yield card.asset, "without output"
        elif card.asset in chosen:
            yield card.asset, _NOT_WHOLE
        elif card.review == "wrong":
            yield card.asset, "wrong"
        elif card.excluded:
            yield card.asset, "excluded"
        else:
            yield card.asset, "needs review" if card.asset in need_review else "not signed off"


def _describe_results(
    cards: Sequence[Card], inside: Collection[str], need_review: Collection[str], left_out: dict[str, str]
) -> str:
    parts = [f"{len(inside)} of {pluralize(len(cards), 'result')}" if left_out else pluralize(len(inside), "result")]
    counts = Counter(left_out.values())
    if left_out:
        parts.append(f"not in it: {', '.join(f'{counts[why]} {why}' for why in _REMEDIES if counts[why])}")
    open_ones = sum(card.asset in inside and card.asset in need_review for card in cards)
    old = sum(card.asset in inside and bool(card.stale) for card in cards)
    needs, them = ("needs", "it") if open_ones == 1 else ("need", "them")
    parts += [f"{open_ones} in it {needs} review: look at {them} first"] * bool(open_ones)
    parts += [f"{old} in it {'is' if old == 1 else 'are'} not up to date"] * bool(old)
    return f"{'; '.join(parts)}."


# The report


def _start_report(session: Session) -> Job:
    cards = session.pages.cards
    ran = sum(card.output != "none" for card in cards)
    if not ran:
        raise _nothing_written()

    def write(progress: JobProgress, path: Path) -> str:
        project, stop = session.project, batch.ExecutionOptions(stop=progress.is_stopped)
        summary = summarize_outputs(project)
        program = project.program() or Program()
        made = build_run_report(project, program, project.layout.edited, summary, execution=stop)
        with progress.stage(len(made.assets), "drawing") as advance:
            options = batch.ReportOptions(progress=advance, execution=stop)
            batch.write_report(path, made.header, made.assets, program=made.program, options=options)
        lacking = len(project.assets()) - summary.total
        rest = f" Not in it: {lacking} without output." if lacking else ""
        return f"{summary}.{rest}"

    title = f"Drawing the report of {pluralize(ran, 'result')}"
    return _start(session, f"{to_file_name(session.project.name, 'report')}.html", title, min(ran, 120), write)
