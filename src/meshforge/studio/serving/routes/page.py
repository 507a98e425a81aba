"""The page itself: files without any data in them, which need no token."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from meshforge.errors import MeshForgeError

BUILT = Path(__file__).parent.parent.parent / "static"


class Page(StaticFiles):
    """The built page. What has a digest in its name is kept by browsers; the rest is asked for anew."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        answer = await super().get_response(path, scope)
        kept = "private, max-age=31536000, immutable" if path.startswith("assets/") else "no-cache"
        answer.headers["Cache-Control"] = kept
        return answer


def page_in(folder: Path) -> Any:
    """The page in a folder. Raises MeshForgeError where it was not built."""
    if not (folder / "index.html").is_file():
        raise MeshForgeError(
            "the page of the studio is not built", where=str(folder), remedy="Build it: script/build-web"
        )
    return Page(directory=folder, html=True)
