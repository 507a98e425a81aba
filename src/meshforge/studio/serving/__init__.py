"""The studio as a server on this machine: addresses, guard, and the built page; its door: `serve`."""

from meshforge.studio.serving.routes.page import BUILT
from meshforge.studio.serving.serve import serve
from meshforge.studio.state import Opening

__all__ = ["BUILT", "Opening", "serve"]
