"""Held assets are listed by reason: one line for all that are held for the same."""

from __future__ import annotations

from typing import cast

from meshforge.project import ProjectReview, format_review
from meshforge.signoff import Assessment, Reason, ResultStatus


def text_of(reasons: dict[str, tuple[float, str]], held: int = 12) -> list[str]:
    assets = {name: ResultStatus(p, (Reason("candidate", why),) if why else ()) for name, (p, why) in reasons.items()}

    class Found:
        assessment = Assessment(assets)

    return format_review(cast(ProjectReview, Found()), held).splitlines()[1:-1]


def test_assets_of_one_reason_share_a_line_with_the_range_of_their_probabilities() -> None:
    reasons = {f"t{k}": (0.9 + 0.004 * k, "outlier") for k in range(9)} | {"odd": (0.5, "a solid block")}
    assert text_of(reasons) == ["  odd (50%): a solid block", "  t0, t1, t2, t3, t4 and 4 more (90% to 93%): outlier"]


def test_the_order_is_that_of_the_least_probable_of_each_reason_and_what_is_not_listed_is_counted() -> None:
    reasons = {"a": (0.3, "x"), "b": (0.2, "y"), "c": (0.6, "x"), "d": (0.7, "z"), "e": (0.8, "z"), "f": (0.9, "")}
    assert text_of(reasons, held=2) == ["  b (20%): y", "  a, c (30% to 60%): x", "  and 3 more (all with --json)"]
    assert text_of(reasons)[-1] == "  f (90%)"
