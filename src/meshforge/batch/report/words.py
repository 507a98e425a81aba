"""Numbers and counts as words."""

from __future__ import annotations


def change(before: int, after: int) -> str:
    """How much less or more, in per cent, with a true minus sign; `no change` where there is none."""
    if before == after:
        return "no change"
    if before == 0:
        return f"+{after}"
    share = round(100 * (after - before) / before)
    return f"{'−' if after < before else '+'}{abs(share)} %"


def duration(seconds: float) -> str:
    """Seconds below two minutes with one decimal, else minutes."""
    return f"{seconds:.1f} s" if seconds < 120 else f"{seconds / 60:.0f} min"
