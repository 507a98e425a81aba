"""The addresses of the studio, by what they are about."""

from meshforge.studio.serving.routes import assets, edits, jobs, language, page, pictures, socket, uploads

ROUTERS = (assets.router, edits.router, jobs.router, language.router, pictures.router, socket.router, uploads.router)

__all__ = ["ROUTERS", "page"]
