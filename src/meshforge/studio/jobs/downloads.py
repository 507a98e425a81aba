"""Jobs that make a file for the browser: a zip of the outputs, the report, or a turntable of before and after."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from itertools import count
from pathlib import Path
from uuid import uuid4

from meshforge import batch
from meshforge.common import UsageError, pluralize
from meshforge.language import Program
from meshforge.project import build_run_report, summarize_outputs
from meshforge.rendering import encode_gif, list_turns
from meshforge.studio.errors import NotHereError
from meshforge.studio.jobs.outputs import list_signed_off
from meshforge.studio.jobs.turntable import FRAMES_A_TASK, TurntableAsset, draw_turntable
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
    written = [card for card in session.pages.cards if card.output in ("edited", "unchanged")]
    match request.what:
        case "results":
            return _start_results(session, written, request.signed_only)
        case "report":
            return _start_report(session)
        case "turntable":
            return _start_turntable(session, written, request)


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


def _start_results(session: Session, written: Sequence[Card], signed_only: bool) -> Job:
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


# The turntable


def _start_turntable(session: Session, written: Sequence[Card], request: DownloadJob) -> Job:
    if not written:
        raise _nothing_written()
    project, out = session.project, session.project.layout.edited
    ids = [card.asset for card in written]
    if request.asset is not None:
        session.check_assets(request.asset)
        if request.asset not in ids:
            raise UsageError("it has no output to be shown", where=request.asset, remedy="Apply the program to it.")
        ids = [request.asset]
    ids = ids[: request.count]
    assets = []
    for asset, read in zip(ids, project.readers(ids), strict=True):
        stamp = batch.read_stamp(out, asset)
        if stamp is None or not stamp.is_whole(out):
            raise NotHereError(
                "files of its output are gone or changed", where=asset, remedy="Apply the program again."
            )
        assets.append(TurntableAsset(asset, read, out / stamp.out))

    def write(progress: JobProgress, path: Path) -> str:
        parts = count(1)
        options = batch.ExecutionOptions(
            stop=progress.is_stopped, progress=lambda: progress.advance(next(parts) * FRAMES_A_TASK)
        )
        program, words = project.program() or Program(), tuple(project.vocabulary)
        pictures = draw_turntable(assets, program, words, options)
        progress.raise_if_stopped()
        path.write_bytes(encode_gif(pictures))
        what = ids[0] if len(ids) == 1 else pluralize(len(ids), "asset")
        return f"{what}, before and after."

    words = [session.project.name, *([ids[0]] if request.asset else []), "turntable"]
    title = f"Drawing a turntable of {ids[0] if len(ids) == 1 else pluralize(len(ids), 'asset')}"
    return _start(session, f"{to_file_name(*words)}.gif", title, len(ids) * len(list_turns()), write)
