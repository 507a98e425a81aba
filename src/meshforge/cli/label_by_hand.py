"""`meshforge label PROJECT ASSET 'HULLS=LABEL' ...`: labels that a person gives on the command line."""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import typer

from meshforge.cli.hulls import find_hulls
from meshforge.cli.options import asset_id
from meshforge.cli.terminal import print_json
from meshforge.common import UsageError, escape_name, is_text, pluralize, quote_path, suggest_among
from meshforge.labels import label_command
from meshforge.project import Project, list_renamed_files
from meshforge.store import History
from meshforge.symbolic import Label, SymbolicMesh, is_class_name


def label_by_hand(
    project: Project, asset: str, texts: Sequence[str], vocabulary: Sequence[str] | None, *, json: bool
) -> None:
    """Give labels to hulls of an asset, and say what was done; the studio can undo it.

    texts: `HULLS=LABEL` each, of which the last one counts for a hull; without a label, the labels are taken away.
    vocabulary: to be set before, None for that of the project. Raises MeshForgeError, with nothing written, where
    anything of it is wrong.
    """
    if not texts and "=" in asset:
        remedy = f"meshforge label {quote_path(project.folder)} ASSET '{asset}'"
        raise UsageError(f"{asset}: of which asset?", remedy=remedy)
    asset = asset_id(asset, project)
    mesh, words = project.mesh(asset), project.words if vocabulary is None else vocabulary
    if not texts:
        remedy = label_command(project.folder, asset, next(iter(mesh.index), "HULLS"), words)
        raise UsageError(f"what is to be labelled on {asset} is missing", remedy=remedy)
    see = f"meshforge info {quote_path(Path(asset))} --project {quote_path(project.folder)}"
    labels = _parse_labels(texts, mesh, words, see)
    done = _write_labels(project, asset, labels, vocabulary)
    before = {name: mesh.hull_of(name).annotation for name in mesh.index}
    after = before | {name: Label(label, 1.0, "user") if label else None for name, label in labels.items()}
    changed = {name: labels[name] for name in labels if after[name] != before[name]}
    bare = sum(label is None for label in after.values())
    if json:
        print_json({"asset": asset, "labels": changed, "same": len(labels) - len(changed), "unlabelled": bare})
        return
    rest = f"{pluralize(bare, 'hull')} of {len(after)} without a label" if bare else "every hull has a label"
    typer.echo(f"{done or f'{escape_name(asset)}: nothing to change'}; {rest}")


def rename_labels(project: Project, texts: Sequence[str]) -> None:
    """Give labels other names, `LABEL=NAME` each, as entries of the history. Raises MeshForgeError for one that is
    wrong; those before it are done."""
    for text in texts:
        old, sign, new = (part.strip() for part in text.partition("="))
        if not (sign and old and new and is_text(text)):
            problem = f"--rename {text}: it needs a label and its new name, in UTF-8"
            raise UsageError(problem, remedy="Write it so: part_a=leg.")
        title, edit = f"{old} renamed {new}", {"kind": "rename-label", "old": old, "new": new}
        with History(project.folder).record(title, edit, list_renamed_files(project)):
            project.rename_label(old, new)
        typer.echo(title)


def _write_labels(
    project: Project, asset: str, labels: Mapping[str, str | None], vocabulary: Sequence[str] | None
) -> str | None:
    """Write labels and vocabulary as one entry of the history; the title of that, None where nothing changed."""
    counts, layout, history = Counter(labels.values()), project.layout, History(project.folder)
    parts = [f"{pluralize(n, 'hull')} labelled {label}" for label, n in counts.items() if label is not None]
    parts += [f"label of {pluralize(counts[None], 'hull')} taken away"] if counts[None] else []
    title, paths = (
        f"{asset}: {', '.join(parts)}",
        [layout.labels(asset), *([layout.settings] if vocabulary is not None else [])],
    )
    with history.record(title, {"asset": asset, "labels": dict(labels)}, paths) as at:
        if vocabulary is not None:
            project.set_vocabulary(vocabulary)
        project.set_labels(asset, labels)
    return title if history.state.undoable > at else None


def _parse_labels(texts: Sequence[str], mesh: SymbolicMesh, words: Sequence[str], see: str) -> dict[str, str | None]:
    """The label of each hull that is named, None for none, in the order of the mesh; see: what lists the names."""
    found: dict[str, str | None] = {}
    for text in texts:
        hulls, sign, label = (part.strip() for part in text.rpartition("="))
        if not sign or not hulls:
            raise UsageError(f"{text}: it needs hulls and a label", remedy="Write it so: 'HULLS=LABEL'.")
        if label and label not in words:
            remedy = suggest_among(label, words) + " Set it with: --vocabulary a,b,c" * all(map(is_class_name, words))
            raise UsageError(f"{text}: the label {label!r} is not in the vocabulary", remedy=remedy)
        found |= dict.fromkeys(find_hulls(hulls, mesh.index, text, see), label or None)
    return {name: found[name] for name in mesh.index if name in found}
