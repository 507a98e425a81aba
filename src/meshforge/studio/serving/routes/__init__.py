"""The addresses of the studio, by what they are about."""

from meshforge.studio.serving.routes import assets, checks, edits, jobs, language, page, pictures, socket, uploads

ROUTERS = tuple(room.router for room in (assets, checks, edits, jobs, language, pictures, socket, uploads))

__all__ = ["ROUTERS", "page"]
