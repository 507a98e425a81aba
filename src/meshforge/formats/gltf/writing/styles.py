"""How an edit is written, convention by convention: the base, and the choice between them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from meshforge.asset import Geom
from meshforge.formats.gltf.document import Authored
from meshforge.formats.gltf.writing.draft import Draft


class Style(ABC):
    """Edits one draft.

    renames: whether a node may be given the name that its hull should have; holds: the shapes that come back as they
    are, or, as a box does in a mesh, just as exactly; lacks: why others do not.
    """

    renames = False
    holds: tuple[str, ...] = ("polytope", "box")
    lacks = "meshes have no"

    def __init__(self, draft: Draft) -> None:
        self.draft = draft

    @abstractmethod
    def remove(self, element: Authored) -> None:
        """Take the collision of a node away, all else of it stays."""

    @abstractmethod
    def keep_pieces(self, element: Authored, kept: Sequence[int]) -> None:
        """Leave some pieces of a node only."""

    @abstractmethod
    def add_hull(self, geom: Geom, own: str, body: int | None, parent: Authored | None) -> None:
        """Add a hull; own: its name without the body; body: the node of that; parent: the node it comes after."""

    def split_node(self, element: Authored, kept: Sequence[int], mesh: int, own: Sequence[str]) -> list[int]:
        """Give a node that lost its mesh a child for each kept piece of that, ahead of others; own: their names."""
        draft, gone = self.draft, self.draft.remove_mesh(element.node)
        assert element.owner is not None  # only meshes have several pieces
        made: list[int] = []
        for k, name in zip(kept, own, strict=True):
            parted = draft.add_mesh(draft.extract_pieces(mesh, element.owner, [k]), mesh)
            made.append(draft.add_node({"name": name, **gone, "mesh": parted}, element.node, at=len(made)))
            draft.expected[made[-1]] = (element.names[k],)
        return made
