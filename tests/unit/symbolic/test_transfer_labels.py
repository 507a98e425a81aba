from __future__ import annotations

from pathlib import Path

from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Hull, Label, LabelFile, SymbolicMesh, read_labels, transfer_labels, write_labels


def mesh(**places: float) -> SymbolicMesh:
    """Unit boxes by name, each at its place along X."""
    return SymbolicMesh(
        tuple(Hull(n, "body", Box.of_bounds(Aabb([x, 0, 0], [x + 1, 1, 1]))) for n, x in places.items())
    )


def labelled(folder: Path, before: SymbolicMesh) -> LabelFile:
    """The labels file of a mesh, each hull labelled by its own name."""
    named = before.with_labels({h.name: Label(f"was_{h.name}") for h in before.hulls})
    write_labels(folder / "labels.json", named, ())
    return read_labels(folder / "labels.json")


def labels(found: SymbolicMesh) -> dict[str, str | None]:
    return {hull.name: hull.label for hull in found.hulls}


def test_labels_stay_with_hulls_that_did_not_change(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2)), mesh(a=0, b=2))
    assert labels(followed.mesh) == {"a": "was_a", "b": "was_b"}
    assert (followed.changed, followed.renamed, followed.gone) == ((), (), ())


def test_a_label_follows_a_hull_that_was_renamed(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2)), mesh(a=0, c=2))
    assert labels(followed.mesh) == {"a": "was_a", "c": "was_b"}
    assert followed.renamed == (("b", "c"),)


def test_labels_follow_hulls_that_were_renumbered(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2, c=4)), mesh(a=2, b=4))
    assert labels(followed.mesh) == {"a": "was_b", "b": "was_c"}
    assert followed.renamed == (("b", "a"), ("c", "b"))
    assert followed.gone == ("a",)


def test_a_hull_of_other_geometry_keeps_its_label_and_is_told(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2)), mesh(a=0, b=3))
    assert labels(followed.mesh) == {"a": "was_a", "b": "was_b"}
    assert followed.changed == ("b",)


def test_a_hull_that_is_not_there_is_told_and_its_label_goes_nowhere(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2)), mesh(a=0, c=3))
    assert labels(followed.mesh) == {"a": "was_a", "c": None}
    assert followed.gone == ("b",)


def test_a_label_follows_no_hull_where_two_are_alike(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=2)), mesh(a=0, c=2, d=2))
    assert labels(followed.mesh) == {"a": "was_a", "c": None, "d": None}
    assert followed.gone == ("b",)


def test_one_of_two_equal_hulls_that_is_left_keeps_its_own_label(tmp_path: Path) -> None:
    followed = transfer_labels(labelled(tmp_path, mesh(a=0, b=0)), mesh(b=0))
    assert labels(followed.mesh) == {"b": "was_b"}
    assert (followed.gone, followed.renamed) == (("a",), ())


def test_labels_without_digests_go_by_name() -> None:
    file = LabelFile(labels={"a": Label("leg"), "z": Label("leg")})
    followed = transfer_labels(file, mesh(a=7))
    assert labels(followed.mesh) == {"a": "leg"}
    assert (followed.changed, followed.gone) == ((), ("z",))
