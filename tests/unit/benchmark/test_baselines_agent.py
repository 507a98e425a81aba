"""The VLM Agent against a real server on loopback: what it is told, what is fed back, and how it ends."""

import json

import pytest

from benchmark.baselines.agent import Agent
from benchmark.baselines.refinement import ROUNDS, refine
from benchmark.baselines.replay import Replay, replay_demonstrations
from benchmark.baselines.verdicts import judge_program
from benchmark.study import TRUE, Bench, Session
from meshforge.language import ACTIONS, Program, show
from tests.unit.benchmark.conftest import few
from tests.unit.benchmark.model_asking import asking, block, by_turn, cost, key, tokens_in, tokens_out

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


def test_the_model_gets_the_language_as_documented_and_steps(bench: Bench, agent: Agent, shown: list[Replay]) -> None:
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
def test_an_agent_that_is_wrong_first_ends_right(bench: Bench, agent: Agent, shown: list[Replay], right: str) -> None:
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
def test_a_model_that_never_gets_it_fails_in_time(bench: Bench, taught: Session, agent: Agent, answer: str) -> None:
    with asking(lambda asked: answer) as (server, client):
        written = refine(client, agent.opening, agent.try_answer, ROOM)
    assert (written.fits, written.text, written.rounds) == (False, None, ROUNDS)
    assert len(server.answered) == ROUNDS
    judged = Session.of_json(json.loads(json.dumps(judge_program(NAME, TRUE.name, 100, taught.shown, written.text))))
    assert (judged.right, judged.judged) == (False, len(bench.samples) - 2)
    assert judged.failures.keys() == bench.samples.keys() - set(taught.shown)
