"""`meshforge diff`: what an edit changed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from meshforge.cli.options import Json
from meshforge.cli.terminal import print_json, remark
from meshforge.formats import load
from meshforge.geometry import is_same_shape
from meshforge.symbolic import SymbolicMesh


def diff(
    before: Annotated[Path, typer.Argument(help="The asset as it was.")],
    after: Annotated[Path, typer.Argument(help="The asset as it is now.")],
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="A picture: before beside after, with what changed marked.")
    ] = None,
    json: Json = False,
) -> None:
    """Compare two assets hull by hull: removed, made, changed, kept, with counts and volumes."""
    if out:
        from meshforge.rendering import check_picture_path, draw_changes, write_picture  # lazy: 40 modules of a picture

        check_picture_path(out)
    old, new = load(before), load(after)
    changes = compare_meshes(old, new)
    if out:
        write_picture(out, draw_changes(old, new, changes["changed"]))
        remark(f"wrote {out}")
    if json:
        print_json({"before": str(before), "after": str(after), **changes})
    else:
        _print_changes(changes)


def compare_meshes(old: SymbolicMesh, new: SymbolicMesh) -> dict[str, Any]:
    """Names of removed, made, changed and kept hulls, and the counts, vertices and volumes of both."""
    near = 1e-6 * max(old.diagonal, new.diagonal)
    both = [name for name in old.index if name in new.index]
    kept = [name for name in both if is_same_shape(old.hull_of(name).shape, new.hull_of(name).shape, near)]
    return {
        "removed": [name for name in old.index if name not in new.index],
        "made": [name for name in new.index if name not in old.index],
        "changed": [name for name in both if name not in set(kept)],
        "kept": kept,
        "hulls": {"before": len(old.hulls), "after": len(new.hulls)},
        "vertices": {"before": _count_vertices(old), "after": _count_vertices(new)},
        "volume": {"before": sum(h.volume for h in old.hulls), "after": sum(h.volume for h in new.hulls)},
    }


def _count_vertices(mesh: SymbolicMesh) -> int:
    return sum(len(h.vertices) for h in mesh.hulls)


def _print_changes(changes: dict[str, Any]) -> None:
    for what in ("hulls", "vertices", "volume"):
        before, after = changes[what]["before"], changes[what]["after"]
        typer.echo(f"{what:9} {before:.6g} -> {after:.6g}" + (" m^3, overlaps counted twice" * (what == "volume")))
    for kind, sign in (("removed", "-"), ("made", "+"), ("changed", "~")):
        for name in changes[kind]:
            typer.echo(f"{sign} {name}")
    typer.echo(f"  {len(changes['kept'])} kept as they were")
