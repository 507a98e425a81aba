from pathlib import Path

import pytest

from meshforge.geometry import Aabb, Box
from meshforge.symbolic import Hull, Label, LabelFile, SymbolicMesh, read_labels, transfer_labels, write_labels


def mesh(**places: float) -> SymbolicMesh:
    return SymbolicMesh(
        tuple(Hull(n, "body", Box.of_bounds(Aabb([x, 0, 0], [x + 1, 1, 1]))) for n, x in places.items())
    )


def labelled(folder: Path, before: SymbolicMesh) -> LabelFile:
    """The labels file of a mesh, each hull labelled by its own name."""
    named = before.with_labels({h.name: Label(f"was_{h.name}") for h in before.hulls})
    write_labels(folder / "labels.json", named, ())
    return read_labels(folder / "labels.json")


@pytest.mark.parametrize(
    ("before", "after", "labels", "renamed", "changed", "gone"),
    [
        pytest.param("a0 b2", "a0 b2", "a=a b=b", "", "", "", id="as they were"),
        pytest.param("a0 b2", "a0 c2", "a=a c=b", "b>c", "", "", id="renamed"),
        pytest.param("a0 b2 c4", "a2 b4", "a=b b=c", "b>a c>b", "", "a", id="renumbered"),
        pytest.param("a0 b2", "a0 b3", "a=a b=b", "", "b", "", id="of other geometry"),
        pytest.param("a0 b2", "a0 c3", "a=a c=", "", "", "b", id="gone"),
        pytest.param("a0 b2", "a0 c2 d2", "a=a c= d=", "", "", "b", id="two are alike"),
        pytest.param("a0 b0", "b0", "b=b", "", "", "a", id="one of two that are alike is left"),
    ],
)
def test_a_label_follows_its_hull_and_what_became_of_others_is_told(
    tmp_path: Path, before: str, after: str, labels: str, renamed: str, changed: str, gone: str
) -> None:
    old, new = (mesh(**{word[0]: float(word[1:]) for word in text.split()}) for text in (before, after))
    followed = transfer_labels(labelled(tmp_path, old), new)
    found = {hull.name: (hull.label or "").removeprefix("was_") for hull in followed.mesh.hulls}
    assert " ".join(f"{name}={label}" for name, label in found.items()) == labels
    assert " ".join(f"{one}>{other}" for one, other in followed.renamed) == renamed
    assert (" ".join(followed.changed), " ".join(followed.gone)) == (changed, gone)


def test_labels_without_digests_go_by_name() -> None:
    file = LabelFile(labels={"a": Label("leg"), "z": Label("leg")})
    followed = transfer_labels(file, mesh(a=7))
    assert [hull.label for hull in followed.mesh.hulls] == ["leg"]
    assert (followed.changed, followed.gone) == ((), ("z",))
