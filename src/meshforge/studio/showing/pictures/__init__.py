"""Small pictures of assets, which the page colours by itself."""

from meshforge.studio.showing.pictures.digests import edited_digest, picture_digest
from meshforge.studio.showing.pictures.met import met
from meshforge.studio.showing.pictures.thumbnail import thumbnail

__all__ = ["edited_digest", "met", "picture_digest", "thumbnail"]
