"""Jobs on outputs: checking them, and copying them into a folder of their own."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.batch import OWN_FOLDERS, STATE, file_digest, read_stamp
from meshforge.common import (
    ProjectError,
    UsageError,
    join_names,
    plain_path,
    pluralize,
    replace_atomically,
    write_atomically,
)
from meshforge.studio.session.job_runner import JobProgress
from meshforge.studio.wire.asset import Fault
from meshforge.studio.wire.jobs import ExportJob, Job, JobLine

if TYPE_CHECKING:
    from meshforge.studio.session.session import Session


EXPORT_MARK = ".meshforge-export"
"""The file that an export leaves in its folder: the names of all that was exported, one a line."""
_RESERVED = (*OWN_FOLDERS, STATE)


def start_check(desk: Session) -> Job:
    """Begin to check all outputs. Raises ProjectError where there are none."""
    assets = tuple(card.asset for card in desk.pages.cards if card.check)
    if not assets:
        raise ProjectError("there is no output to be checked", remedy="Apply the program first.")

    def work(running: JobProgress) -> str:
        odd = failed = 0
        for asset, found in desk.checks.check_all(desk.project, assets, running.advance, lambda: running.is_stopped):
            line = to_line(asset, found)
            odd, failed = odd + bool(line.text and line.status == "done"), failed + (line.status == "failed")
            running.add_line(line)
            desk.refresh_queue.add([asset])
        broken = f"; {failed} could not be checked" if failed else ""
        return f"{pluralize(len(assets), 'result')}: {odd} with findings, limits of engines apart{broken}."

    return desk.jobs.start("check", f"Checking {pluralize(len(assets), 'result')}", len(assets), work)


def to_line(asset: str, found: tuple[Fault, ...] | str) -> JobLine:
    """What is told of one output: the rules that do not hold, without those of engines, or why it cannot be told."""
    if isinstance(found, str):
        return JobLine(asset=asset, status="failed", text=found)
    rules = dict.fromkeys(fault.rule for fault in found if fault.engine is None)
    return JobLine(asset=asset, status="done", text=join_names(list(rules)))


def start_export(desk: Session, request: ExportJob) -> Job:
    """Begin to export. Raises UsageError for a folder that is not to be written, or holds other things."""
    folder = _check_folder(desk, request.folder)
    known = _read_mark(folder)
    rows = [card for card in desk.pages.cards if not request.accepted_only or card.review == "accepted"]
    if not rows:
        which = "accepted" if request.accepted_only else "there"
        raise UsageError(f"no output is {which} to be exported", remedy="Apply the program, and accept what is right.")
    edited = desk.project.layout.edited

    def work(running: JobProgress) -> str:
        kept: dict[str, None] = {}
        done = 0
        for card in rows:
            running.raise_if_stopped()
            line = _export_asset(edited, folder, card.asset, known, kept)
            done += line.status == "done"
            running.add_line(line)
            running.advance()
        _remove_files(folder, [name for name in known if name not in kept])
        return f"{pluralize(done, 'asset')} exported."

    return desk.jobs.start("export", f"Exporting {pluralize(len(rows), 'asset')}", len(rows), work, str(folder))


def _export_asset(edited: Path, folder: Path, asset: str, known: dict[str, None], kept: dict[str, None]) -> JobLine:
    """Copy all files of one output, the main one last, so that it never names what is not there."""
    stamp = read_stamp(edited, asset)
    if stamp is None or stamp.status not in ("edited", "unchanged"):
        return JobLine(asset=asset, status="skipped", text="it has no output")
    if not stamp.is_whole(edited):
        return JobLine(asset=asset, status="failed", text="files of its output are gone or changed: apply it again")
    names = sorted(stamp.outputs, key=lambda name: (name == stamp.out, name))
    foreign = [name for name in names if name not in known and (folder / name).exists()]
    if foreign:
        return JobLine(asset=asset, status="failed", text=f"{folder / foreign[0]} is there, and no export wrote it")
    known |= dict.fromkeys(names)
    write_atomically(folder / EXPORT_MARK, "".join(f"{name}\n" for name in known))
    for name in names:
        _copy_file(edited / name, folder / name)
        kept[name] = None
    return JobLine(asset=asset, status="done", text=pluralize(len(names), "file"))


def _copy_file(source: Path, target: Path) -> None:
    if target.is_file() and file_digest(target) == file_digest(source):
        return
    with replace_atomically(target) as draft:
        shutil.copyfile(source, draft)
        draft.chmod(source.stat().st_mode & 0o777)


def _check_folder(desk: Session, name: str) -> Path:
    """The folder to write: below the project, or the one that was allowed when the studio was opened."""
    root, allowed = desk.project.folder, desk.options.export
    folder = plain_path(root / name)
    if allowed and folder == plain_path(allowed):
        return folder
    remedy = "Choose a folder of its own inside of the project, or start the studio with --export DIR."
    real = Path(os.path.realpath(folder))
    if not real.is_relative_to(os.path.realpath(root)) or real == Path(os.path.realpath(root)):
        raise UsageError("outputs are exported below the project only", where=str(folder), remedy=remedy)
    if folder.relative_to(root).parts[0] in _RESERVED:
        raise UsageError("this folder belongs to the project itself", where=str(folder), remedy=remedy)
    return folder


def _read_mark(folder: Path) -> dict[str, None]:
    """The files of earlier exports into a folder. Raises UsageError where it holds anything else only."""
    mark = folder / EXPORT_MARK
    if mark.is_file():
        return dict.fromkeys(mark.read_text(encoding="utf-8").splitlines())
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        remedy = "Choose a new folder, or one of an earlier export."
        raise UsageError("this folder holds something else", where=str(folder), remedy=remedy)
    return {}


def _remove_files(folder: Path, names: Iterable[str]) -> None:
    """Take away what earlier exports wrote and this one does not."""
    gone = set(names)
    for name in gone:
        (folder / name).unlink(missing_ok=True)
    left = [name for name in _read_mark(folder) if name not in gone]
    write_atomically(folder / EXPORT_MARK, "".join(f"{name}\n" for name in left))
