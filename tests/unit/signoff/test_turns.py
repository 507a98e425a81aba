"""Whether assets are to be turned: what is asked, of which asset, and where nothing is asked."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.label_model import model_family
from meshforge.language import Delete, Program
from meshforge.signoff import ReviewState, review_family
from meshforge.signoff.groups import find_turned_asset
from meshforge.signoff.question import NO, NOT_OF_FAMILY, YES
from meshforge.symbolic import Asset, Document, SymbolicMesh
from meshforge.synthesis import Demonstration, OrientationSuggestion, Step, synthesize
from tests.program_parts import parse_orient
from tests.synthesis_boxes import posed, rack, turned

LABELS = ("panel", "leg")
UP = "orient +Z: Is(leg) -> Is(panel)"


def racks(lying: str = "YZX") -> dict[str, SymbolicMesh]:
    """Nine racks, every third on its side."""
    standing = {f"rack {k}": rack(0.02 * k - 0.1, 1 + k % 3) for k in range(9)}
    return {name: turned(mesh, lying) if k % 3 == 2 else mesh for k, (name, mesh) in enumerate(standing.items())}


def ask_of(meshes: Mapping[str, SymbolicMesh], directive: str = UP, *differs: str, beside: bool = True) -> str | None:
    """The asset that is asked about. beside: whether there is a program."""
    suggested = OrientationSuggestion(parse_orient(directive), (2,), "", (2,) if beside else (), differs)
    return find_turned_asset(ReviewState(meshes, Program(LABELS)), suggested)


def test_the_question_is_one_sentence_and_the_first_choice_leaves_assets_as_they_are() -> None:
    meshes = racks()
    boards = {hull.name for hull in meshes["rack 1"].hulls if hull.name.startswith("top")}
    demo = Demonstration(meshes["rack 1"], [Step(1, boards, Delete())], "rack 1")
    state = ReviewState(meshes, Program(LABELS), demos={"rack 1": demo})
    outcome = synthesize([demo], meshes, vocabulary=LABELS)
    assert outcome.program
    asked = review_family(state, outcome, model_family(list(meshes.values()))).questions
    (question,) = (one for one in asked if one.kind == "orientation")
    assert question.text == "Should rack 2 stand like this?"
    assert [(one.id, one.orient) for one in question.choices] == [(NO, None), (YES, parse_orient(UP))]


def test_an_asset_whose_selections_change_is_asked_about_before_others() -> None:
    assert ask_of(racks()) == "rack 2", "it turns neither least nor most"
    assert ask_of(racks(), UP, "rack 1", "rack 8") == "rack 8"
    assert ask_of(racks(), UP, "rack 1") == "rack 2", "the turn does not change rack 1"


@pytest.mark.parametrize("beside", [True, False])
def test_nothing_is_asked_where_an_asset_that_has_labels_lacks_a_landmark(beside: bool) -> None:
    meshes = racks()
    without = meshes["rack 4"].with_labels({"leg": None})
    assert ask_of({**meshes, "rack 4": without}, beside=beside) is None
    bare = without.with_labels(dict.fromkeys(without.index))
    assert ask_of({**meshes, "rack 4": bare}, beside=beside)
    excluded = ReviewState({**meshes, "rack 4": without}, Program(LABELS), excluded={"rack 4": NOT_OF_FAMILY})
    assert find_turned_asset(excluded, OrientationSuggestion(parse_orient(UP), (2,), ""))


def test_nothing_is_asked_beside_a_program_where_all_assets_stand_upright() -> None:
    standing = racks("XYZ")
    assert ask_of(standing) is None
    about_z = {name: posed(mesh, (0.8, 0.6, 0), (-0.6, 0.8, 0)) for name, mesh in standing.items()}
    assert ask_of(about_z) is None
    assert ask_of(about_z, beside=False), "it is seen, and no rules were found without it"
    assert ask_of(standing, beside=False) is None, "nobody would see a difference"


def test_nothing_is_asked_where_assets_that_stand_upright_would_lean() -> None:
    leaning = {name: posed(mesh, (1, 0, 0), (0, 0.8, 0.6)) for name, mesh in racks("XYZ").items()}
    assert ask_of(leaning, "orient +Z: Is(panel) -> Is(leg)")
    far = {f"rack {k}": rack(3.0 + k / 10) for k in range(4)}  # the foot is far aside
    assert ask_of(far) is None
    assert ask_of({**far, "lying": turned(rack(), "YZX")}) is None, "it sets one upright, and four would lean"
    assert ask_of(far, beside=False)


def test_assets_whose_files_say_that_y_is_up_stand_as_they_are_shown() -> None:
    lying = {name: posed(mesh, (1, 0, 0), (0, 0, -1)) for name, mesh in racks("XYZ").items()}
    assert ask_of(lying)
    file = Asset(Path("rack.glb"), "gltf", (), (), Document(), up="y")
    assert ask_of({name: replace(mesh, asset=file) for name, mesh in lying.items()}) is None
