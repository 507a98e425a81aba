"""Small pictures of assets, which the page colours by itself."""

from meshforge.studio.pictures.met import met
from meshforge.studio.pictures.thumbnail import thumbnail

__all__ = ["met", "thumbnail"]
