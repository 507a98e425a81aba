"""Checking all outputs, as a job; what was measured before is not measured again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from meshforge.errors import ProjectError
from meshforge.studio.state.running import Running
from meshforge.studio.wire.checks import Fault
from meshforge.studio.wire.jobs import Job, JobLine
from meshforge.words import counted, listed

if TYPE_CHECKING:
    from meshforge.studio.state import Desk


def check_job(desk: Desk) -> Job:
    """Begin to check all outputs. Raises ProjectError where there are none."""
    assets = tuple(card.asset for card in desk.pages.cards if card.check)
    if not assets:
        raise ProjectError("there is no output to be checked", remedy="Apply the program first.")

    def work(running: Running) -> str:
        odd = failed = 0
        for asset, found in desk.checks.check_all(desk.project, assets, running.advance, lambda: running.is_stopped):
            line = check_line(asset, found)
            odd, failed = odd + bool(line.text and line.status == "done"), failed + (line.status == "failed")
            running.add_line(line)
            desk.refresh_queue.add([asset])
        broken = f"; {failed} could not be checked" if failed else ""
        return f"{counted(len(assets), 'result')}: {odd} with findings, limits of engines apart{broken}."

    return desk.jobs.start("check", f"Checking {counted(len(assets), 'result')}", len(assets), work)


def check_line(asset: str, found: tuple[Fault, ...] | str) -> JobLine:
    """What is told of one output: the rules that do not hold, without those of engines, or why it cannot be told."""
    if isinstance(found, str):
        return JobLine(asset=asset, status="failed", text=found)
    rules = dict.fromkeys(fault.rule for fault in found if fault.engine is None)
    return JobLine(asset=asset, status="done", text=listed(list(rules)))
