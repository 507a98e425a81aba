"""A picture of an asset's hulls."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.formats import Source, to_mesh
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

    from meshforge.rendering import ColorBy, View


def render(
    asset: SymbolicMesh | Source,
    out: str | Path | None = None,
    *,
    views: View | Sequence[View] = "iso",
    color_by: ColorBy | None = None,
    size: tuple[int, int] = (900, 700),
    highlight: Collection[str] | None = None,
    ghost: bool = False,
    names: bool = False,
) -> Image:
    """Draw an asset, one colour a hull or a label; the same input gives the same picture. It needs no display.

    asset: a mesh, or what `load` reads. out: a PNG or JPEG to write. views: one, or several that share the picture:
    `iso`, `front`, `left`, `top`, `front-right-above` and so on. color_by: `hull`, `label`, `body` or `confidence`, by
    default the label where there are labels, else the hull. size: width and height [px]. highlight: names of hulls to
    show in a strong colour. ghost: show the visual mesh, too. names: write the names of hulls on them, or numbers with
    a list of names below.
    Raises AssetError for a file that cannot be read, UsageError for an unknown view or colouring, an impossible size,
    or a picture that cannot be written.
    """
    from meshforge import rendering  # lazy: 40 modules that checks and differences do not need

    if out is not None:
        rendering.check_picture_path(Path(out))
    mesh = to_mesh(asset)
    image = rendering.render(
        mesh,
        views=(views,) if isinstance(views, str) else views,
        color_by=color_by or ("label" if mesh.labels else "hull"),
        size=size,
        highlight=None if highlight is None else frozenset(highlight),
        ghost=tuple(mesh.asset.visuals) if ghost and mesh.asset else None,
        names=names,
    )
    if out is not None:
        rendering.write_picture(Path(out), image)
    return image
