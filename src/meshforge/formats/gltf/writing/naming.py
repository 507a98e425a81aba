"""Names of nodes in an edited file, so that hulls read back under those they have."""

from __future__ import annotations

from meshforge.formats.gltf.document import BODY, GltfDocument
from meshforge.formats.gltf.reading.bodies import body_nodes
from meshforge.formats.gltf.reading.conventions import source_name
from meshforge.formats.gltf.reading.names import hull_names
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.meshfile.gltf import Scene


def settle(draft: Draft, document: GltfDocument, *, renames: bool) -> dict[str, str]:
    """Name the nodes whose pieces would else read back under other names, where the convention allows it.

    Returns the names that cannot be had all the same, with what they read back as.
    """
    misread = _misread(draft, document)
    for _ in range(4 if renames and misread else 0):
        for node, (body, _) in misread.items():
            draft.node(node)["name"] = _own_name(draft.expected[node], body)
        misread = _misread(draft, document)
    return {
        wanted: name
        for node, (_, names) in misread.items()
        for wanted, name in zip(draft.expected[node], names, strict=True)
        if wanted != name
    }


def _misread(draft: Draft, document: GltfDocument) -> dict[int, tuple[str | None, tuple[str, ...]]]:
    """The nodes whose pieces would read back under other names, with their body, and these names."""
    scene = Scene(draft.tree, None, draft.scene.path)
    owners, names = body_nodes(scene), dict(document.bodies)
    order = [node for node in scene.placements if node in draft.expected]
    bodies = [(names[owners[node]] if node in owners else BODY) if names else None for node in order]
    sources = [
        (body, source_name(scene, scene.placements[node], document.convention), len(draft.expected[node]))
        for node, body in zip(order, bodies, strict=True)
    ]
    return {
        node: (body, read)
        for node, body, read in zip(order, bodies, hull_names(sources), strict=True)
        if read != draft.expected[node]
    }


def _own_name(wanted: tuple[str, ...], body: str | None) -> str:
    """The name of a node whose pieces are to have names: that of the first, without body and `#0`."""
    name = wanted[0].removeprefix(f"{body}/")
    return name if len(wanted) == 1 else name.removesuffix("#0")
