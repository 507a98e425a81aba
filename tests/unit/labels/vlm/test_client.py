import json
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, QuestionError, RefusalError
from tests.loopback import FAULTS, GARBAGE, Asked, Fault, serving, status
from tests.unit.labels.vlm.asking import SCHEMA, VARIABLE, client, endpoint, key, question

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key")
PASSING = [fault for fault in FAULTS if fault.kind not in ("cut", "garbage")]


def first(*faults: Fault) -> object:
    """These faults for the first requests that are no probe, then none."""
    rest = iter(faults)
    return lambda asked: None if asked.is_probe else next(rest, None)


def test_an_answer_is_counted_and_kept_and_not_asked_for_again(tmp_path: Path) -> None:
    with serving(lambda asked: "leg") as server:
        one = client(server, tmp_path, input_price=2.0, output_price=10.0)
        reply = one.ask(question())
        assert reply.text == "leg"
        assert (one.usage.input, one.usage.output) == (server.usage["input"], server.usage["output"])
        assert one.usage.cost == pytest.approx((2 * server.usage["input"] + 10 * server.usage["output"]) / 1e6)
        again = client(server, tmp_path, input_price=2.0, output_price=10.0)
        known = again.ask(question())
        assert known == reply
        assert (again.usage.cached, again.usage.answered, again.usage.cost) == (1, 0, 0.0)
        assert len(server.answered) == 1


@pytest.mark.parametrize("schema", ["honoured", "ignored", "refused"])
@pytest.mark.parametrize("thinks", [False, True])
def test_what_the_server_refuses_is_not_asked_of_it(schema: str, thinks: bool) -> None:
    with serving(lambda asked: "leg", schema=schema, thinks=thinks) as server:
        one = client(server)
        assert one.ask(question(schema=SCHEMA)).text == "leg"
        limit = "max_completion_tokens" if thinks else "max_tokens"
        refused = {"response_format"} if schema == "refused" else set()
        assert one.refused == refused | ({"temperature", "max_tokens"} if thinks else set())
        (asked,) = server.answered
        sent = {"response_format", "temperature", "max_tokens", "max_completion_tokens"} & asked.body.keys()
        wanted = {limit} | (set() if schema == "refused" else {"response_format"})
        assert sent == wanted | (set() if thinks else {"temperature"})
        assert asked.body.get("temperature", 0) == 0


def test_pictures_arrive_as_they_are_and_are_kept_beside_the_answer(tmp_path: Path) -> None:
    from PIL import Image

    from meshforge.rendering import encode_png

    pictures = [encode_png(Image.new("RGB", (20, 10), colour)) for colour in ("white", "black")]
    with serving(lambda asked: "leg") as server:
        one = client(server, tmp_path)
        asked = question("Look.", *pictures)
        one.ask(asked)
        assert list(server.answered[0].pictures) == pictures
    kept = {path.read_bytes() for path in (tmp_path / "pictures").iterdir()}
    assert kept == set(pictures)
    (answer,) = (tmp_path / "answers").iterdir()
    data = json.loads(answer.read_text())
    assert data["answered"]["text"] == "leg"
    names = [part["image_url"]["url"] for part in data["asked"]["messages"][1]["content"][1:]]
    assert [(tmp_path / "pictures" / f"{name}.png").read_bytes() for name in names] == pictures


@pytest.mark.parametrize("fault", PASSING, ids=lambda fault: f"{fault.kind} {fault.code}")
def test_faults_that_pass_are_tried_again_and_cost_nothing(fault: Fault) -> None:
    with serving(lambda asked: "leg", fault=first(fault, fault), slow=1.0) as server:
        one = client(server, timeout=0.5, input_price=1.0, output_price=1.0)
        assert one.ask(question()).text == "leg"
        assert (one.usage.retries, one.usage.answered) == (2, 2)
        assert (one.usage.input, one.usage.output) == (server.usage["input"], server.usage["output"])
        lost = fault.kind != "status"
        assert (one.usage.perhaps > 0) == lost


def test_a_question_that_gets_no_answer_does_not_end_the_others() -> None:
    def fault(asked: Asked) -> Fault | None:
        return status(500, "out of order") if "hard" in asked.text else None

    with serving(lambda asked: "leg", fault=fault) as server:
        one = client(server, retries=2)
        with pytest.raises(QuestionError, match="no answer: 500: out of order"):
            one.ask(question("hard"))
        assert one.end is None
        assert one.ask(question("easy")).text == "leg"


def test_when_nobody_answers_any_more_the_asking_ends() -> None:
    with serving(lambda asked: "leg", fault=first(*[status(503)] * 1000)) as server:
        one = client(server, retries=1, concurrency=2)
        ends = 0
        for k in range(8):
            with pytest.raises(QuestionError) as raised:
                one.ask(question(str(k)))
            ends += isinstance(raised.value, EndError)
        assert ends == 4
        assert one.end and "several questions in a row got no answer, the last: 503" in one.end.message
        assert sum(not asked.is_probe for asked, _, _ in server.asked) == 2 * 5


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        (status(401, "no such key"), "does not accept the key: no such key"),
        (status(403, "not allowed"), "does not accept the key: not allowed"),
        (status(400, "API key not valid. Please pass a valid API key."), "does not accept the key"),
        (status(404, "model is not there"), "there is no model 'loopback-vl' here: model is not there"),
        (status(402, "pay first"), "no money left: pay first"),
        (status(429, "You exceeded your current quota", type="insufficient_quota"), "no money left"),
    ],
)
def test_what_no_patience_mends_ends_the_asking_with_one_message(fault: Fault, message: str) -> None:
    with serving(lambda asked: "leg", fault=first(*[fault] * 5)) as server:
        one = client(server)
        with pytest.raises(EndError, match=message):
            one.ask(question())
        before = len(server.asked)
        with pytest.raises(EndError, match=message):
            one.ask(question("something else"))
        assert len(server.asked) == before


def test_a_server_that_is_not_there_is_told_soon() -> None:
    with serving(lambda asked: "leg") as server:
        pass
    with pytest.raises(
        EndError, match=r"the server cannot be reached: .*\n  Is the server running, and base_url right\?"
    ):
        client(server).ask(question())


def test_a_model_without_eyes_ends_the_asking() -> None:
    with (
        serving(lambda asked: "leg", sees=False) as server,
        pytest.raises(EndError, match="this model takes no pictures"),
    ):
        client(server).ask(question())


def test_a_refused_question_is_asked_without_its_schema_and_then_given_up() -> None:
    def fault(asked: Asked) -> Fault | None:
        if asked.is_probe:
            return None
        return status(400, "too long" if "long" in asked.text else "schema is too complex" if asked.schema else "")

    def only_schemas(asked: Asked) -> Fault | None:
        return status(400, "schema is too complex") if asked.schema and not asked.is_probe else None

    with serving(lambda asked: "leg", fault=only_schemas) as server:
        one = client(server)
        assert one.ask(question(schema=SCHEMA)).text == "leg"
    with serving(lambda asked: "leg", fault=fault) as server:
        one = client(server)
        with pytest.raises(RefusalError, match=r"the server refused the question \(400\): too long"):
            one.ask(question("a long one", schema=SCHEMA))
        assert one.end is None
        assert (one.usage.retries, sum(not asked.is_probe for asked, _, _ in server.asked)) == (0, 2)


def test_the_key_is_in_no_message_and_in_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, key: str) -> None:
    with serving(lambda asked: f"your key is not told, {asked.key == key}") as server:
        one = client(server, tmp_path)
        assert one.ask(question()).text.endswith("True")
        assert not any(key in path.read_text(errors="replace") for path in tmp_path.rglob("*") if path.is_file())
        monkeypatch.setenv(VARIABLE, "sk-another-secret")
        with pytest.raises(EndError) as raised:
            client(server).ask(question())
        assert "sk-another-secret" not in raised.value.message
        assert f"The key is what the environment variable {VARIABLE} holds." in raised.value.message


def test_a_key_is_sent_only_where_it_belongs(monkeypatch: pytest.MonkeyPatch, key: str) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", key)
    with serving(lambda asked: "leg", key="") as server:
        client(server, key_env=None).ask(question())
        assert {asked.key for asked, _, _ in server.asked} == {"none"}
    names = {
        "https://api.openai.com/v1": "OPENAI_API_KEY",
        "https://generativelanguage.googleapis.com/v1beta/openai/": "GEMINI_API_KEY",
        "https://api.anthropic.com/v1/": "ANTHROPIC_API_KEY",
        "http://localhost:11434/v1": "",
    }
    assert {url: endpoint(url, None).key_name for url in names} == names
    assert endpoint("https://api.openai.com/v1", "MINE_API_KEY").key_name == "MINE_API_KEY"


def test_a_key_that_is_not_there_is_told_by_its_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE)
    with serving(lambda asked: "leg") as server:
        with pytest.raises(
            EndError, match=f"{VARIABLE}, which holds the key, is not set\n  Set it: export {VARIABLE}="
        ):
            client(server).ask(question())
        assert not server.asked


@pytest.mark.parametrize(
    ("url", "message"),
    [
        ("api.openai.com/v1", "is no address"),
        ("ftp://host/v1", "is no address"),
        ("https://me:secret@host/v1", "a base_url holds no key, name or query"),
        ("https://host/v1?key=secret", "a base_url holds no key, name or query"),
    ],
)
def test_an_address_that_cannot_be_is_told_without_its_secrets(url: str, message: str) -> None:
    with pytest.raises(UsageError, match=message) as raised:
        endpoint(url)
    assert "secret" not in raised.value.message


def test_the_same_question_at_one_time_is_asked_once(tmp_path: Path) -> None:
    with serving(lambda asked: "leg", delay=0.1) as server:
        one = client(server, tmp_path, concurrency=4)
        together = threading.Barrier(4)

        def ask(_: int) -> str:
            together.wait()
            return one.ask(question()).text

        with ThreadPoolExecutor(4) as pool:
            assert set(pool.map(ask, range(4))) == {"leg"}
        assert len(server.answered) == 1 and sum(asked.is_probe for asked, _, _ in server.asked) == 1
        assert (one.usage.answered, one.usage.cached) == (2, 3)  # the question about the red picture is one, too


DAMAGES: dict[str, Callable[[str], str]] = {
    "empty": lambda text: "",
    "cut": lambda text: text[: len(text) // 2],
    "another thing": lambda text: "[1, 2]",
    "no answer": lambda text: text.replace('"answered"', '"unanswered"'),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_answer_is_asked_for_again(tmp_path: Path, damage: str) -> None:
    with serving(lambda asked: "leg") as server:
        one = client(server, tmp_path)
        one.ask(question())
        (path,) = (tmp_path / "answers").iterdir()
        whole = path.read_text()
        path.write_text(DAMAGES[damage](whole))
        assert path.read_text() != whole
        assert one.ask(question()).text == "leg"
        assert len(server.answered) == 2
        assert path.read_text() == whole


def test_a_server_that_tells_no_tokens_is_told_to_be_estimated() -> None:
    with serving(lambda asked: "leg", tells=False) as server:
        one = client(server)
        one.ask(question("word " * 300))
        assert one.usage.estimated
        assert 300 < one.usage.input < 3000


def test_a_stop_ends_the_asking() -> None:
    wanted: list[bool] = []
    with serving(lambda asked: "leg") as server:
        one = client(server, stop=lambda: bool(wanted))
        one.ask(question())
        wanted.append(True)
        with pytest.raises(EndError, match=r"stopped\n  What was answered is kept"):
            one.ask(question("another"))
        assert len(server.answered) == 1


def test_garbage_that_tells_what_it_cost_is_counted_and_not_asked_for_again() -> None:
    with serving(lambda asked: "leg") as server:
        real = server._completion

        def completion(asked: Asked, *, cut: bool) -> dict[str, object]:
            data = real(asked, cut=cut)
            return data if asked.is_probe else data | {"choices": []}

        server._completion = completion  # type: ignore[method-assign]
        one = client(server)
        with pytest.raises(QuestionError, match=r"no answer: .* something that is no answer"):
            one.ask(question())
        assert (one.usage.input, one.usage.output) == (server.usage["input"], server.usage["output"])
        assert (one.usage.retries, one.usage.perhaps) == (0, 0)


def test_without_the_sdk_the_message_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    with serving(lambda asked: "leg") as server, pytest.raises(EndError, match=r"pip install 'meshforge\[vlm\]'"):
        monkeypatch.setitem(sys.modules, "openai", None)
        client(server).ask(question())


@pytest.mark.parametrize("kind", ["application/json", "text/html"])
def test_a_page_in_place_of_json_is_one_error_at_once(kind: str) -> None:
    page = replace(GARBAGE, headers={"Content-Type": kind})
    with serving(lambda asked: "leg", fault=first(page)) as server:
        one = client(server)
        for _ in range(2):
            with pytest.raises(EndError, match=r"no JSON: <html>All our servers are busy</html>\n  Is base_url"):
                one.ask(question())
        assert sum(not asked.is_probe for asked, _, _ in server.asked) == 1
        assert one.usage.answered == 1  # the question about the red picture
