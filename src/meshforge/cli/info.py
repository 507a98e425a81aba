"""`meshforge info`: what an asset holds."""

from pathlib import Path
from typing import Annotated, Any

import typer

from meshforge import symbolic
from meshforge.cli.console import fold_notes
from meshforge.cli.options import AssetFile, InProject, Json, LabelsPath, asset_id, open_asset
from meshforge.cli.terminal import print_json
from meshforge.common import escape_name, pluralize
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Shape, Sphere


def info(
    asset: AssetFile,
    labels: LabelsPath = None,
    project: InProject = None,
    json: Json = False,
    geometry: Annotated[bool, typer.Option("--geometry", help="With --json: the points of every hull.")] = False,
) -> None:
    """Show hulls, labels, bodies, contacts and near misses of an asset, in the frame it comes in."""
    mesh = open_asset(asset, labels, project)
    if json:
        print_json(describe_asset(mesh, str(asset), geometry=geometry) | (_describe_result_status(asset, project)))
    else:
        _print_asset(mesh, str(asset))
    if mesh.asset:
        mesh.asset.refuse_missing()


def _describe_result_status(asset: Path, folder: Path | None) -> dict[str, Any]:
    if folder is None:
        return {}
    from meshforge.project import Project  # lazy: 500 modules that only --project needs

    project = Project.open(folder)
    name = asset_id(asset, project)
    found = (one.result_status.to_json() for one in project.status().assets if one.id == name)
    return next(found, {})  # of none that is not of the family


def describe_asset(mesh: symbolic.SymbolicMesh, asset: str, *, geometry: bool = False) -> dict[str, Any]:
    """Return the JSON shape of `info`."""
    names = [hull.name for hull in mesh.hulls]
    source = mesh.asset
    return {
        "asset": asset,
        "format": source.format if source else None,
        "diagonal": mesh.diagonal,
        "notes": list(source.notes) if source else [],
        "hulls": [_describe_hull(hull, geometry) for hull in mesh.hulls],
        "non_convex": [
            {"name": o.name, "body": o.body, "reason": o.reason} for o in (source.non_convex if source else ())
        ],
        "contacts": [[names[i], names[j]] for i, j in sorted(mesh.contacts)],
        "near_misses": [[names[i], names[j], gap] for i, j, gap in mesh.near_misses],
    }


def _describe_hull(hull: symbolic.Hull, geometry: bool) -> dict[str, Any]:
    bounds = hull.aabb
    row = {
        "name": hull.name,
        "body": hull.body,
        "label": hull.label,
        "confidence": hull.confidence,
        "source": hull.source,
        "aabb": {"min": bounds.min.tolist(), "max": bounds.max.tolist()},
        "volume": hull.volume,
        "vertices": len(hull.vertices),
        "faces": len(hull.faces),
        "primitive": _describe_primitive(hull.primitive),
    }
    return row | {"points": hull.vertices.tolist()} if geometry else row


def _describe_primitive(shape: Shape | None) -> dict[str, Any] | None:
    match shape:
        case Box():
            size: dict[str, Any] = {"size": (2 * shape.half).tolist()}
        case Sphere():
            size = {"radius": shape.radius}
        case Cylinder() | Capsule():
            size = {"radius": shape.radius, "length": 2 * shape.half_length}
        case Ellipsoid():
            size = {"radii": shape.radii.tolist()}
        case _:
            return None
    pose = {"position": shape.pose.translation.tolist(), "rotation": shape.pose.rotation.tolist()}
    return {"kind": shape.kind, **size, **pose}


def _print_asset(mesh: symbolic.SymbolicMesh, asset: str) -> None:
    source = mesh.asset
    non_convex = source.non_convex if source else ()
    bodies = len({h.body for h in mesh.hulls} | {o.body for o in non_convex})
    head = [source.format if source else "", pluralize(len(mesh.hulls), "hull"), pluralize(bodies, "body", "bodies")]
    head += [pluralize(len(non_convex), "non-convex piece")] if non_convex else []
    head += [pluralize(len(mesh.contacts), "contact")]
    head += [f"diagonal {mesh.diagonal:.4g} m"] if mesh.hulls else []  # it is that of the hulls
    typer.echo(f"{escape_name(asset)}: {', '.join(head)}")
    for note in fold_notes(source.notes) if source else ():
        typer.echo(f"  note: {note}")
    if mesh.hulls:
        typer.echo()
        rows = (
            (k, h.name, h.body, h.label, h.shape.kind, len(h.vertices), f"{h.volume:.3g}", len(mesh.neighbours(k)))
            for k, h in enumerate(mesh.hulls)
        )
        from meshforge.cli.console import print_table  # lazy: 50 modules of rich that --json does not need

        columns = ("#", "hull", "body", "label", "kind", "vertices", "volume", "touches")
        print_table(columns, rows, right=("#", "vertices", "volume", "touches"))
    if non_convex:
        typer.echo("\nNon-convex (never selected, written back untouched; `meshforge prepare` makes hulls of it):")
        for piece in non_convex:
            typer.echo(f"  {escape_name(piece.name)}: {piece.reason}")
    if mesh.near_misses:
        typer.echo(f"\nNear misses (apart, yet within three times the contact distance {mesh.contact_distance:.3g} m):")
        for i, j, gap in mesh.near_misses[:12]:
            typer.echo(f"  {escape_name(mesh.hulls[i].name)}  {escape_name(mesh.hulls[j].name)}  {gap:.3g} m")
        if len(mesh.near_misses) > 12:
            typer.echo(f"  and {len(mesh.near_misses) - 12} more (all with --json)")
    typer.echo("\nBoxes and contacts are those of the frame the file comes in.")
