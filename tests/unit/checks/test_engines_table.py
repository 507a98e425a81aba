from pathlib import Path

import pytest

from meshforge.engines import ENGINES, Engine

PAGE = Path(__file__).parents[3] / "docs" / "engines.md"


def rows(engine: Engine) -> list[str]:
    """The rows of the table of `docs/engines.md` about an engine."""
    found = []
    for limit in engine.limits:
        number = f"{limit.bound} {limit.number:g} {limit.what}"
        found.append((f"`{engine.name}-{limit.rule}`", number, limit.severity, limit.problem, limit.source))
    if engine.hulls is not None:
        number = f"most {engine.hulls} hulls a body"
        found.append((f"`{engine.name}-hulls`", number, "warning", engine.hulls_problem, engine.hulls_source))
    kinds = ", ".join(sorted(engine.primitives))
    found.append(
        (f"`{engine.name}-primitives`", f"only {kinds}", "warning", engine.instead or "—", engine.primitives_source)
    )
    return ["| " + " | ".join(row) + " |" for row in found]


@pytest.mark.parametrize("engine", ENGINES.values(), ids=ENGINES.keys())
def test_the_page_shows_each_limit_with_its_source(engine: Engine) -> None:
    lines = PAGE.read_text("utf-8").splitlines()
    start = lines.index(f"## {engine.title}")
    table = [line for line in lines[start + 1 : start + 5 + len(rows(engine))] if line.startswith("| `")]
    assert table == rows(engine)
