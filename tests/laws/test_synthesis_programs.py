"""What is learned from demonstrations of a hidden program does what was shown, and is never larger."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.common import MeshForgeError
from meshforge.language import Program, Rule, size_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, Demonstration, Found, Options, synthesize
from tests.examples import examples
from tests.strategies import TEMPLATES, grid_boxes, meshes, programs
from tests.synthesis_showing import demonstrated

LABELS = ("a", "b", "c")
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS, max_size=6), min_size=1, max_size=3)
hidden_programs = programs(LABELS, orient=st.none(), max_rules=3)


def shown(program: Program, batch: list[SymbolicMesh]) -> tuple[list[Rule], list[Demonstration]]:
    assume(all(mesh.labels for mesh in batch))
    try:
        rules, demos = demonstrated(program, batch)
    except MeshForgeError:  # a shape that cannot be made; nothing to learn from
        assume(False)
    assume(rules)
    return rules, demos


def learned(program: Program, demos: list[Demonstration]) -> Found | Ambiguous:
    outcome = synthesize(
        demos,
        templates=TEMPLATES,
        vocabulary=LABELS,
        options=Options(repair=False, contact=program.contact, extremity=program.extremity),
    )
    assert isinstance(outcome, Found | Ambiguous)
    return outcome


@pytest.mark.slow
@examples(100)
@given(hidden_programs, batches)
def test_the_learned_program_does_what_was_shown_and_is_not_larger(hidden: Program, batch: list[SymbolicMesh]) -> None:
    rules, demos = shown(hidden, batch)
    program = learned(hidden, demos).program
    assert [(rule.action, rule.label) for rule in program.rules] == [(rule.action, rule.label) for rule in rules]
    for mine, theirs in zip(program.rules, rules, strict=True):
        assert size_of(mine.extractor) <= size_of(theirs.extractor)
    for mesh in batch:
        names = [{hull.name for hull in p.run(mesh, TEMPLATES).mesh.hulls} for p in (program, hidden)]
        assert names[0] == names[1]


@pytest.mark.slow
@examples(50)
@given(hidden_programs, batches, st.data())
def test_a_demonstration_that_ends_early_leaves_the_later_rules_to_the_others(
    hidden: Program, batch: list[SymbolicMesh], data: st.DataObject
) -> None:
    _, demos = shown(hidden, batch)
    short = data.draw(st.integers(0, len(demos) - 1))
    cut = data.draw(st.sampled_from(possible_cuts(demos, short)))
    demos[short] = Demonstration(demos[short].mesh, demos[short].steps[:cut], demos[short].name)
    program = learned(hidden, demos).program
    for demo in demos:
        trace = program.run(demo.mesh, TEMPLATES).trace
        assert [step.select for step in demo.steps] == [frozenset(done.selected) for done in trace[: len(demo.steps)]]


def possible_cuts(demos: list[Demonstration], short: int) -> list[int]:
    """How many steps of that demonstration may be kept, so that each later rule is shown by another one."""
    count = len(demos[short].steps)
    elsewhere = [any(d.steps[k].shown for d in demos if d is not demos[short]) for k in range(count)]
    return [cut for cut in range(count + 1) if all(elsewhere[cut:])]


_OUTCOMES = """
import json
from dataclasses import asdict
from benchmark.learning.families import VOCABULARIES, family
from meshforge.language import Delete, Program, select, show
from meshforge.symbolic import Label
from meshforge.synthesis import Demonstration, Step, outcome_to_json, synthesize
from tests.unit.synthesis.test_repair import examples_of, explained
from tests.unit.synthesis.test_running_example import learned

def ambiguous(mislabelled):
    meshes = {str(k): mesh for k, mesh in enumerate(family("table", 25, seed=1))}
    (rule,) = Program.parse("Attach(Is(handle), Is(drawer)) => Delete").rules
    chosen = {name: select(rule.extractor, mesh) for name, mesh in meshes.items()}
    name = next(name for name in meshes if chosen[name])
    mesh = meshes[name]
    shown = {mesh.hulls[k].name for k in chosen[name]}
    if mislabelled:
        mesh = mesh.with_labels({min(shown): Label("leg", 0.5, "vlm")})
    demo = Demonstration(mesh, [Step(1, shown, Delete())], name)
    return synthesize([demo], {**meshes, name: mesh}, vocabulary=VOCABULARIES["table"])

for outcome in (learned(), ambiguous(False), ambiguous(True)):
    out = outcome_to_json(outcome)
    del out["seconds"]
    print(json.dumps(out))
said = explained(examples_of("Is(leg)", {"leg0_low": "drawer", "leg3_high": "panel"}, {"leg1_low": None}))
out = [show(said.extractor), [asdict(row) for row in said.fixes], said.beliefs, said.whys, said.cost]
print(json.dumps({"status": f"{len(out[1])} corrections", "out": out}))
"""


def _print_outcomes(seed: int) -> str:
    """What a process with a hash seed prints. One that comes to an error, as happened twice in a full run and was never
    explained, says it on the terminal, and is started once more."""
    for last in (False, True):
        environment = {**os.environ, "PYTHONHASHSEED": str(seed)}
        command = [sys.executable, "-c", _OUTCOMES]
        run = subprocess.run(command, cwd=Path(__file__).parents[2], env=environment, capture_output=True, text=True)
        if run.returncode:
            print(run.stderr, file=sys.__stderr__)
            assert not last, run.stderr
        else:
            break
    return run.stdout


@pytest.mark.slow
def test_the_outcome_does_not_depend_on_the_hash_seed() -> None:
    printed = [_print_outcomes(seed) for seed in (1, 2)]
    assert [json.loads(line)["status"] for line in printed[0].splitlines()] == [
        "found",
        "ambiguous",
        "repair",
        "3 corrections",
    ]
    assert printed[0] == printed[1]
