from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from meshforge.common import UsageError
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import EndError, QuestionError
from tests.loopback import FAULTS, Server, serving, sometimes
from tests.unit.labels.vlm.asking import client, endpoint, key, question

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key")
PRICES = {"input_price": 1000.0, "output_price": 1000.0}


def spent(server: Server) -> float:
    """What the server charged, at these prices [$]."""
    return server.usage["input"] / 1000 + server.usage["output"] / 1000


def ask_all(one: Client, count: int, **how: int) -> int:
    """Ask so many questions at once; gives how many got an answer."""

    def ask(number: int) -> bool:
        try:
            one.ask(question(f"{number} " + "word " * 200, limit=100, **how))
        except QuestionError:
            return False
        return True

    with ThreadPoolExecutor(one.endpoint.settings.concurrency) as pool:
        return sum(pool.map(ask, range(count)))


@pytest.mark.slow
@pytest.mark.parametrize("most", [0.0, 3.0, 5.0, 8.0])
@pytest.mark.parametrize("concurrency", [1, 6])
def test_no_more_is_spent_than_may_be(tmp_path: Path, most: float, concurrency: int) -> None:
    with serving(lambda asked: "leg " * 60) as server:
        one = client(server, tmp_path, max_cost=most, concurrency=concurrency, **PRICES)
        answered = ask_all(one, 40)
        assert spent(server) <= most
        assert one.usage.cost == pytest.approx(spent(server))
        assert isinstance(one.end, EndError)
        assert f"of ${most:g} are spent" in one.end.message
        assert answered == len(server.answered) < 40
        assert answered > 2 or most < 5
        more = client(server, tmp_path, max_cost=1000.0, concurrency=concurrency, **PRICES)
        assert ask_all(more, 40) == 40
        assert len(server.answered) == 40  # nothing was asked twice


def test_with_faults_attempts_without_answer_count_as_if_they_were_charged_for(tmp_path: Path) -> None:
    with serving(lambda asked: "leg " * 60, fault=sometimes(0.3, FAULTS), slow=0.3) as server:
        one = client(server, tmp_path, max_cost=12.0, concurrency=4, timeout=0.15, **PRICES)
        ask_all(one, 60)
        bill = one.usage
        assert bill.cost is not None and bill.cost <= 12.0 and bill.perhaps > 0
        assert bill.cost <= spent(server) + 1e-9 <= bill.cost + bill.perhaps


def test_other_questions_under_way_are_waited_for_and_do_not_end_it(tmp_path: Path) -> None:
    """Each may cost more than it does: two at once would pass the limit, one after the other does not."""
    with serving(lambda asked: "leg", delay=0.02) as server:
        one = client(server, tmp_path, max_cost=8.5, concurrency=6, **PRICES)
        assert ask_all(one, 6) == 6
        assert one.end is None


def test_a_limit_without_prices_is_refused() -> None:
    with pytest.raises(UsageError, match="a limit on the cost needs to know the prices"):
        Client(endpoint("http://localhost/v1"), max_cost=1.0)
