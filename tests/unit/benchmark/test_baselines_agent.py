"""The VLM Agent against a real server on loopback: what it is told, what is fed back, and how it ends."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from benchmark.baselines.agent import Agent
from benchmark.baselines.refinement import ROUNDS, find_code, refine
from benchmark.baselines.replay import Replay, replay_demonstrations
from benchmark.baselines.verdicts import judge_program
from benchmark.study import FLAT, TRUE, Bench, Session
from meshforge.language import ACTIONS, Program, show
from tests.loopback import CUT, Asked
from tests.unit.benchmark.conftest import few
from tests.unit.benchmark.model_asking import asking, block, by_turn, cost, key, tokens_in, tokens_out, turn

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key", "few_meshes")
NAME = "cup-medium"
ROOM = 500


@pytest.fixture(scope="module")
def bench() -> Bench:
    return few(NAME)


@pytest.fixture(scope="module")
def taught(bench: Bench) -> Session:
    """Two meshes shown, on which every rule has something to do; few hulls, so that two pictures show all."""
    busy = [name for name, done in bench.truth.reference.items() if done and all(done) and "fine" not in name]
    return Session(NAME, TRUE.name, 100, "medium", shown=[busy[0], busy[1], busy[0]])


@pytest.fixture(scope="module")
def shown(bench: Bench, taught: Session) -> list[Replay]:
    return replay_demonstrations(bench, taught)


@pytest.fixture(scope="module")
def agent(bench: Bench, shown: list[Replay]) -> Agent:
    return Agent(bench.task, shown)


@pytest.fixture(scope="module")
def right(bench: Bench) -> str:
    """The rules that are meant, without the header, which is settled."""
    return "".join(f"{rule}\n" for rule in bench.task.program.rules)


def test_the_model_is_told_the_language_as_it_is_documented_and_all_that_was_shown(
    bench: Bench, agent: Agent, shown: list[Replay]
) -> None:
    system, user = agent.opening
    told = str(system.parts[0])
    assert all(f"| `{name}" in told for name in ACTIONS)
    assert all(f"\n{rule}: " in told for rule in ("program", "_extractor", "union", "rule", "action"))
    assert "From Python" not in told
    words = "\n".join(part for part in user.parts if isinstance(part, str))
    orient = bench.task.program.orient
    assert orient
    assert show(orient) in words
    assert not any(str(rule.extractor) in words for rule in bench.task.program.rules[1:])
    assert bench.task.says not in words
    assert len(shown) == 2
    for one in shown:
        for hull in one.before.hulls:
            assert f"\n{hull.name}, {hull.label}, (" in words
        for step in one.demo.steps:
            assert f"{step.rule}. {step.action}: on {', '.join(sorted(step.select or ()))}" in words
        made = [name for rule in range(1, len(one.stages)) for name in one.find_products(rule)]
        assert made
        assert all(f" {name}, " in words for name in made[:3])
    pictures = [part for part in user.parts if isinstance(part, bytes)]
    assert len(pictures) == 3 * len(shown)
    assert all(picture.startswith(b"\x89PNG") for picture in pictures)
    assert agent.opening == Agent(bench.task, shown).opening


@pytest.mark.usefixtures("small_pictures")
def test_an_agent_that_is_wrong_at_first_is_told_why_and_ends_right(
    bench: Bench, agent: Agent, shown: list[Replay], right: str
) -> None:
    wrong = right.replace("Is(misc)", "Is(wall)", 1)
    answers = [block("Is(base => Delete"), block(wrong), block(right)]
    with asking(by_turn(*answers)) as (server, client):
        written = refine(client, agent.opening, agent.try_answer, ROOM)
        assert client.usage.cost is not None
    assert (written.fits, written.rounds, written.wrong) == (True, 3, [None, len(shown), 0])
    assert Program.parse(written.text or "") == bench.task.program
    _, second, third = server.answered
    said = str(second.parts[-1])
    assert "The program does not parse:\nprogram:1:9: " in said
    assert "        ^" in said
    said = str(third.parts[-1])
    assert said.startswith("The program does not do what was shown.\n")
    for one in shown:
        walls = [hull.name for hull in one.before.hulls if hull.label == "wall"]
        misc = [hull.name for hull in one.before.hulls if hull.label == "misc"]
        assert f"{one.name}, rule 1, Is(wall): selects, but should not: {walls[0]} (wall)" in said
        assert f"should select, too: {misc[0]} (misc)" in said
    assert third.pictures == second.pictures
    assert (written.input, written.output) == (tokens_in(server), tokens_out(*answers))
    assert written.cost == pytest.approx(cost(written.input, written.output))


@pytest.mark.usefixtures("small_pictures")
@pytest.mark.parametrize(
    "answer",
    ["", "I am sorry, I cannot do that.", "```mf\n```", "```\nlabels wall\n```", "{\x00\ud7ff[", "```mf\nAll =>"],
)
def test_a_model_that_never_gets_it_ends_as_failure_within_the_rounds(
    bench: Bench, taught: Session, agent: Agent, answer: str
) -> None:
    with asking(lambda asked: answer) as (server, client):
        written = refine(client, agent.opening, agent.try_answer, ROOM)
    assert (written.fits, written.text, written.rounds) == (False, None, ROUNDS)
    assert len(server.answered) == ROUNDS
    judged = Session.of_json(json.loads(json.dumps(judge_program(NAME, TRUE.name, 100, taught.shown, written.text))))
    assert (judged.right, judged.judged) == (False, len(bench.samples) - 2)
    assert judged.failures.keys() == bench.samples.keys() - set(taught.shown)


@pytest.mark.usefixtures("small_pictures")
def test_of_answers_that_are_all_wrong_the_one_that_did_best_counts_and_is_judged(
    bench: Bench, taught: Session, agent: Agent, right: str
) -> None:
    worst = right.replace("Is(misc)", "All", 1)
    better = right.replace("Attach(Is(handle), Is(wall))", "Geo(Is(handle), +Z)")
    with asking(by_turn(block(worst), block(better), "nonsense")) as (_, client):
        written = refine(client, agent.opening, agent.try_answer, ROOM)
    assert not written.fits
    assert written.text is not None
    assert Program.parse(written.text).rules == Program.parse(better).rules
    assert written.wrong[:2] == [2, agent.try_answer(better).wrong]
    assert written.wrong[2:] == [None] * (ROUNDS - 2)
    judged = Session.of_json(judge_program(NAME, TRUE.name, 100, taught.shown, written.text))
    assert not judged.right
    best = Session.of_json(judge_program(NAME, TRUE.name, 100, taught.shown, str(bench.task.program)))
    assert best.right
    assert len(best.failures) < len(judged.failures) <= judged.judged


def test_programs_with_other_rules_that_do_the_same_are_right(bench: Bench, shown: list[Replay], agent: Agent) -> None:
    one, two = bench.task.program.rules
    other = replace(bench.task.program, rules=(one, one, two))
    tried = agent.try_answer(str(other))
    assert (tried.wrong, tried.said) == (0, ())
    less = agent.try_answer(str(replace(bench.task.program, rules=(one,))))
    assert less.wrong == len(shown)
    assert 'The steps were: Delete, then Each(Replace("eye.obj")); each is a rule.' in str(less.said[0])
    unknown = agent.try_answer("Is(hadle) => Delete")
    assert unknown.text is None
    assert "Did you mean 'handle'?" in str(unknown.said[0])
    missing = agent.try_answer('All => Replace("gear.obj")')
    assert missing.wrong == len(shown)
    assert "it fails: there is no template" in str(missing.said[0])


def test_labels_that_are_wrong_stay_so_but_for_landmarks_that_a_person_could_show_nothing_without(
    bench: Bench,
) -> None:
    seeds = range(100, 104)
    changed = 0
    for seed in seeds:
        desk = bench.desk("flat", seed)
        names = [name for name, done in bench.truth.reference.items() if done][:8]
        for one in replay_demonstrations(bench, Session(NAME, FLAT.name, seed, shown=names)):
            noisy, true = desk.meshes[one.name], bench.truth.meshes[one.name]
            for hull, was, right in zip(one.demo.mesh.hulls, noisy.hulls, true.hulls, strict=True):
                assert hull.label in (was.label, right.label)
                changed += was.label != right.label == hull.label
    assert changed < 8 * len(seeds)


@pytest.mark.usefixtures("small_pictures")
def test_an_answer_that_is_cut_off_is_said_to_be(agent: Agent, right: str) -> None:
    def fault(asked: Asked) -> object:
        return CUT if not asked.is_probe and not turn(asked) else None

    long = "".join(f"# thought {k}\n" for k in range(100)) + right
    with asking(by_turn(block(long), block(right)), fault=fault) as (server, client):
        written = refine(client, agent.opening, agent.try_answer, ROOM)
    assert (written.fits, written.wrong) == (True, [None, 0])
    assert "Your answer was cut off: answer more briefly." in server.answered[-1].text


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        ("```\na\n```", "a"),
        ("x ```a``` y", "x ```a``` y"),
        ("first\n```mf\na\n```\nthen\n```python\nb\nc\n```\n", "b\nc"),
        ("```mf\na\nb", "a\nb"),
        ("a => b", "a => b"),
        ("  ```mf\n  a\n  ```", "a"),
        ("```\n```", ""),
        ("", ""),
    ],
)
def test_the_last_block_of_code_is_the_answer(answer: str, text: str) -> None:
    assert find_code(answer) == text
