"""Labels of rebuilt bodies: inferred together, so that they are no evidence for each other."""

import numpy as np
import pytest

from meshforge.label_model import FamilyModel, FamilyPosterior
from meshforge.symbolic import Label, LabelSource, SymbolicMesh
from tests.synthesis_boxes import table

UNSURE = 0.7


def infer(meshes: list[SymbolicMesh]) -> FamilyPosterior:
    return FamilyModel(meshes).infer([hull.annotation for mesh in meshes for hull in mesh.hulls])


def rebuilt_tables(count: int = 6) -> list[SymbolicMesh]:
    """Tables, all labels from a rebuild, which took handles for drawers everywhere, and was not sure."""
    told = {name: Label(name, 0.95, "rebuild") for name in ("drawer", "leg", "misc", "panel")}
    told["handle"] = Label("drawer", UNSURE, "rebuild")
    meshes = [table(legs=4, drawers=1 + k % 2) for k in range(count)]
    return [mesh.with_labels({hull.name: told[str(hull.label)] for hull in mesh.hulls}) for mesh in meshes]


def chances_of(found: FamilyPosterior, meshes: list[SymbolicMesh], mesh: int, start: str, label: str) -> list[float]:
    rows = zip(meshes[mesh].hulls, found.chances_of(mesh), strict=True)
    return [float(row[found.seen.labels.index(label)]) for hull, row in rows if hull.name.startswith(start)]


def test_labels_of_rebuilds_that_agree_in_an_error_are_no_surer_than_each() -> None:
    meshes = rebuilt_tables()
    found = infer(meshes)
    together, apart = (chances_of(one, meshes, 3, "handle", "drawer") for one in (found, found.discount_rebuilt()))
    assert min(together) > UNSURE + 0.1, "they vouch for each other"
    assert max(apart) <= UNSURE + 1e-9
    assert np.allclose(found.discount_rebuilt().chances.sum(axis=1), 1.0)


def test_what_a_person_said_of_look_alikes_makes_them_surer_or_less_sure() -> None:
    meshes = rebuilt_tables()
    meshes[0] = meshes[0].with_labels(
        {hull.name: Label("handle" if "handle" in hull.name else str(hull.label)) for hull in meshes[0].hulls}
    )
    doubted = infer(meshes).discount_rebuilt()
    assert max(chances_of(doubted, meshes, 4, "handle", "drawer")) <= UNSURE + 1e-9
    assert min(chances_of(doubted, meshes, 4, "leg", "leg")) > 0.95
    assert min(chances_of(doubted, meshes, 0, "handle", "handle")) > 0.99


@pytest.mark.parametrize("source", ["vlm", "file", "user"])
def test_labels_of_other_sources_stay(source: LabelSource) -> None:
    meshes = [table(legs=4, drawers=1 + k % 2) for k in range(4)]
    said = [mesh.with_labels({h.name: Label(str(h.label), 0.6, source) for h in mesh.hulls}) for mesh in meshes]
    found = infer(said)
    assert found.discount_rebuilt() is found


def test_a_family_without_hulls_has_nothing_to_doubt() -> None:
    assert infer([SymbolicMesh(())]).discount_rebuilt().chances.size == 0
