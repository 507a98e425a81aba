"""The projects that were open before, in a small file of the user's state folder."""

from __future__ import annotations

import logging
import os
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path

from meshforge.batch import SETTINGS, hold_lock
from meshforge.common import MeshForgeError, is_file
from meshforge.store.layout import JsonFile, read_derived, write_json
from meshforge.studio.wire.start import RecentProject

_LOG = logging.getLogger(__name__)

MOST_RECENT = 30
"""Projects that are remembered."""


def state_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Return where the studio remembers things: `MESHFORGE_STATE`, else `XDG_STATE_HOME/meshforge`, else
    `~/.local/state/meshforge`."""
    if own := environment.get("MESHFORGE_STATE"):
        return Path(own)
    base = environment.get("XDG_STATE_HOME")
    return (Path(base) if base else Path.home() / ".local" / "state") / "meshforge"


class _Entry(JsonFile):
    folder: str
    name: str
    assets: int = 0
    opened: str = ""


class _RecentFile(JsonFile):
    projects: tuple[_Entry, ...] = ()


class RecentProjects:
    """The projects that were open before, the last one first. state: the user's state folder.

    A list that cannot be read is an empty one, and one that cannot be written stays as it was: neither keeps anybody
    from opening a project.
    """

    def __init__(self, state: Path) -> None:
        self._path, self._lock = state / "recent.json", state / "recent.lock"

    def list(self) -> tuple[RecentProject, ...]:
        """Return all of them, those that are gone too."""
        return tuple(
            RecentProject(
                folder=entry.folder,
                name=entry.name,
                assets=entry.assets,
                opened=entry.opened,
                gone=not is_file(Path(entry.folder) / SETTINGS),
            )
            for entry in self._read().projects
        )

    def add(self, folder: Path, name: str, assets: int) -> None:
        """Put a project first."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        self._change(str(folder), _Entry(folder=str(folder), name=name, assets=assets, opened=now))

    def forget(self, folder: str) -> None:
        """Take a project off the list; its files stay."""
        self._change(folder, None)

    def _change(self, folder: str, first: _Entry | None) -> None:
        try:
            with hold_lock(self._lock, str(self._path)):
                kept = self._read()
                rest = [entry for entry in kept.projects if entry.folder != folder]
                projects = tuple([*([first] if first else []), *rest][:MOST_RECENT])
                write_json(self._path, kept.model_copy(update={"projects": projects}))
        except (OSError, MeshForgeError):
            _LOG.debug("the list of recent projects cannot be written", exc_info=True)

    def _read(self) -> _RecentFile:
        return read_derived(self._path, _RecentFile) or _RecentFile()
