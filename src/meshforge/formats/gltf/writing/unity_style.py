"""Edits of files whose collision lies below nodes that a script in Unity knows by name."""

from __future__ import annotations

from meshforge.formats.gltf.document import Authored
from meshforge.formats.gltf.reading.conventions import below_colliders
from meshforge.formats.gltf.writing.plain_style import PlainStyle
from meshforge.formats.naming.marks import holds_colliders


class UnityStyle(PlainStyle):
    """A hull is a node with a mesh, below a node called `table_colliders`."""

    def holder(self, body: int | None, parent: Authored | None) -> int | None:
        """Beside the parent; without one, beside the first hull of the file."""
        holder = super().holder(body, parent)
        colliding, scene = below_colliders(self.draft.scene), self.draft.scene
        if holder in colliding or (holder is not None and holds_colliders(self.draft.node(holder).get("name"))):
            return holder
        return scene.placements[min(colliding)].parent
