"""Wrong labels of landmark hulls, which turn a demonstrated mesh into another frame than the rest."""

from collections.abc import Callable, Collection, Mapping

from meshforge.language import Delete, show
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import (
    Demonstration,
    Found,
    LabelFix,
    LearningOutcome,
    NeedsRepair,
    Options,
    Repair,
    Step,
    synthesize,
)
from tests.program_parts import parse_orient
from tests.synthesis_boxes import rack

LABELS = ("panel", "leg", "misc")
UP = parse_orient("orient +Z: Is(leg) -> Is(panel)")
WRONG = LabelFix("rack 1", "crate", "leg", "misc")


def family(wrong: Mapping[str, str] | None = None, source: str = "vlm") -> dict[str, SymbolicMesh]:
    """Racks with a crate beside them, labelled by a model; wrong: labels of hulls of `rack 1`."""
    found = {}
    for k in range(9):
        mesh = rack(0.02 * k - 0.1, 1 + k % 3, extra=[("crate", "misc", (5.0, 0.0, 0.6 + 0.02 * k), (0.6, 0.6, 0.6))])
        labels = {hull.name: Label(hull.label or "", 0.9, "vlm") for hull in mesh.hulls}
        if k == 1:
            labels |= {name: Label(label, 0.9, source) for name, label in (wrong or {}).items()}  # type: ignore[arg-type]
        found[f"rack {k}"] = mesh.with_labels(labels)
    return found


def learn(
    meshes: Mapping[str, SymbolicMesh],
    *names: str,
    rejected: Collection[LabelFix] = (),
    repair: bool = True,
    confirm: Callable[[Repair], bool] | None = None,
) -> LearningOutcome:
    """Of the named meshes the topmost boards are deleted."""
    demos = [
        Demonstration(
            meshes[name], [Step(1, {h.name for h in meshes[name].hulls if h.name[:3] == "top"}, Delete())], name
        )
        for name in names
    ]
    options = Options(rejected=tuple(rejected), repair=repair)
    return synthesize(demos, meshes, UP, vocabulary=LABELS, options=options, confirm=confirm)


def test_a_crate_that_is_called_a_leg_is_proposed_for_repair_with_what_becomes_of_frame_and_rule() -> None:
    outcome = learn(family({"crate": "leg"}), "rack 1", "rack 2")
    assert isinstance(outcome, NeedsRepair)
    (repair,) = outcome.repairs
    assert repair.fix == WRONG and repair.belief > 0.75
    assert outcome.proposed and [show(rule.extractor) for rule in outcome.proposed.rules] == ["Geo(Is(panel), +Z)"]
    assert "with it the orientation turns rack 1 by " in repair.why.lower()
    assert "rule 1 has an extractor of 2 nodes, now " in repair.why


def test_a_repair_that_is_confirmed_leads_to_the_program() -> None:
    meshes, asked = family({"crate": "leg"}), list[Repair]()

    def confirm(repair: Repair) -> bool:
        asked.append(repair)
        return True

    outcome = learn(meshes, "rack 1", "rack 2", confirm=confirm)
    assert isinstance(outcome, Found)
    assert [repair.fix for repair in asked] == [WRONG]
    assert show(outcome.program.rules[0].extractor) == "Geo(Is(panel), +Z)"


def test_right_labels_refused_repairs_and_all_labels_where_repair_is_switched_off_are_left_alone() -> None:
    assert not learn(family(), "rack 1", "rack 2").repairs
    assert not learn(family({"crate": "leg"}), "rack 1", "rack 2", repair=False).repairs
    refused = learn(family({"crate": "leg"}), "rack 1", "rack 2", rejected=[WRONG])
    assert WRONG not in [repair.fix for repair in refused.repairs]
