"""Assets beyond one request: read in worker processes, kept in memory, drawn, uploaded.

Doors: `KeptProject`, a project that remembers its assets; `Thumbnails`; `Uploads`.
"""

from meshforge.studio.assets.meshes import KeptProject, Meshes
from meshforge.studio.assets.thumbnails import Of, Thumbnails
from meshforge.studio.assets.uploads import Uploads, new_assets

__all__ = ["KeptProject", "Meshes", "Of", "Thumbnails", "Uploads", "new_assets"]
