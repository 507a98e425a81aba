"""RQ2: the paper's baselines over the same tasks; they need an endpoint, and are not run without one."""

from __future__ import annotations

from benchmark.evaluation import paper
from benchmark.evaluation.figures import by_task, fpr, shown, spread
from benchmark.evaluation.sessions import sessions
from benchmark.report import Result, Table, Tell
from benchmark.study import FULL, NOISY

BASELINES = ("VLM Agent", "VLM Blender")


def measure(tell: Tell, quick: bool) -> Result:
    """Our row from the same sessions as RQ1, and the rows of the baselines."""
    rows = sessions((FULL, NOISY), tell, quick)
    ours = {condition.name: shown(spread(by_task(rows, condition.name), fpr)) for condition in (FULL, NOISY)}
    table = Table(
        "Functional pass rate",
        ("", "FPR (paper)", "FPR, true labels", "FPR, noisy labels"),
        (
            ("MeshForge", paper.RQ2["MeshForge"], ours[FULL.name], ours[NOISY.name]),
            *((name, paper.RQ2[name], "not run", "not run") for name in BASELINES),
        ),
    )
    return Result(
        "comparison",
        "RQ2: comparison",
        (table,),
        notes=(
            "*VLM Agent*: a model writes the program in the language; *VLM Blender*: it writes a Blender script. Both "
            "need an OpenAI-compatible endpoint; none was configured, so nothing is said about them here.",
            paper.CONDITIONS,
        ),
    )
