"""The running example of the paper: five rules from two tables, one of which lies on its side."""

from meshforge.language import Action, Delete, Each, Is, LandmarkPair, Merge, Orient, Replace
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Found, Step, synthesize
from tests.synthesis_boxes import table, turned

LABELS = ("panel", "leg", "handle", "drawer", "misc")
UP = Orient((LandmarkPair("+Z", Is("leg"), Is("panel")),), snap=True)
ACTIONS: tuple[Action, ...] = (Delete(), Replace("box"), Each(Merge()), Each(Replace("box")), Delete())


def shown_on(mesh: SymbolicMesh, name: str) -> Demonstration:
    """What a person would select on a table."""

    def among(*starts: str) -> set[str]:
        return {hull.name for hull in mesh.hulls if hull.name.startswith(starts)}

    drawers = {name for name in among("drawer") if not name.endswith("bottom")}
    targets = [among("residue"), among("top"), among("leg"), among("handle"), drawers]
    steps = [Step(k, select, action) for k, (select, action) in enumerate(zip(targets, ACTIONS, strict=True), 1)]
    return Demonstration(mesh, steps, name)


def learned() -> Found:
    one = shown_on(table(), "upright")
    other = shown_on(turned(table(drawers=2, knob=0.73, litter=3), "YZX"), "lying")
    outcome = synthesize([one, other], orient=UP, vocabulary=LABELS)
    assert isinstance(outcome, Found)
    return outcome


def test_five_rules_are_learned_from_two_tables() -> None:
    expected = """\
labels panel, leg, handle, drawer, misc

orient snap +Z: Is(leg) -> Is(panel)

Is(misc)                              => Delete
Geo(Is(panel), +Z)                    => Replace(box)
Is(leg)                               => Each(Merge)
Attach(Is(handle), Is(drawer))        => Each(Replace(box))
Diff(Is(drawer), Geo(Is(drawer), -Z)) => Delete
"""
    assert str(learned().program) == expected


def test_the_learned_program_edits_a_table_it_has_not_seen() -> None:
    unseen = table(legs=5, drawers=3, knob=None, litter=0)
    result = learned().program.run(unseen)
    names = {hull.name for hull in result.mesh.hulls}
    assert names == {"top_0~1", "shelf", *(f"leg{k}_low~1" for k in range(5))} | {
        name for k in range(3) for name in (f"handle{k}~1", f"drawer{k}_bottom")
    }


def test_each_rule_has_one_reading_and_says_how_far_the_search_went() -> None:
    outcome = learned()
    assert [(r.id, r.rule, r.size, r.belief) for r in outcome.candidates] == [
        ("1.1", 1, 1, 1.0),
        ("2.1", 2, 2, 1.0),
        ("3.1", 3, 1, 1.0),
        ("4.1", 4, 3, 1.0),
        ("5.1", 5, 4, 1.0),
    ]
    assert [tried.size for tried in outcome.tried] == [0, 1, 0, 2, 3]
    assert outcome.rules == outcome.program.rules
