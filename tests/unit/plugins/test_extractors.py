"""A leaf extractor of a plug-in: in Python, in the studio, and what it may do wrong."""

import pickle
from pathlib import Path

import pytest

from meshforge.common import ProgramError
from meshforge.language import All, Attach, Is, Program, explain, parse_extractor, select
from meshforge.studio.queries.programs import build_language_view, check_text
from meshforge.synthesis.search.terms import enumerate_more_leaves, leaf_key
from tests.plugin_packages import page_files
from tests.unit.cli.in_process import Run
from tests.unit.language.scenes import table
from tests.unit.plugins.test_failures import Install, install, run  # noqa: F401 (fixtures)

SMALLER = page_files()["meshforge_example/smaller.py"]
NAMED = """
from dataclasses import dataclass, field
import numpy as np
from meshforge.language import BaseExtractor, TextArgument


@dataclass(frozen=True, slots=True)
class Named(BaseExtractor):
    \"\"\"The hulls whose name begins with a text.\"\"\"

    start: str = field(metadata={"argument": TextArgument()})

    def mask(self, hulls, *bases):
        return np.array([hull.name.startswith(self.start) for hull in hulls.hulls])

    @property
    def phrase(self):
        return f"the hulls called {self.start}…"

    @classmethod
    def enumerate(cls, candidates):
        yield from {cls(hull.name[:3]): None for mesh in candidates.meshes for hull in mesh.hulls}
"""


@pytest.mark.usefixtures("run")
def test_it_is_parsed_printed_said_and_run_in_python(install: Install) -> None:  # noqa: F811
    install("extractors", "Smaller", SMALLER)
    text = "Diff(Smaller(All, 0.05), Is(leg))"
    node = parse_extractor(text)
    assert str(node) == text
    assert explain(node) == "all hulls that are smaller than 5.0% of the asset, except the leg hulls"
    mesh = table()
    total = sum(hull.volume for hull in mesh.hulls)
    small = {k for k, hull in enumerate(mesh.hulls) if hull.volume < 0.05 * total}
    assert select(parse_extractor("Smaller(All, 0.05)"), mesh) == small
    legs = {k for k in small if mesh.hulls[k].label == "leg"}
    assert select(parse_extractor("Smaller(Is(leg), 0.05)"), mesh) == legs
    program = Program.parse("Smaller(Is(leg), 0.05) => Delete")
    assert program.labels == ("leg",)
    assert pickle.loads(pickle.dumps(program)) == program


@pytest.mark.usefixtures("run")
def test_a_base_of_a_plug_in_stands_where_bases_do(install: Install) -> None:  # noqa: F811
    install("extractors", "Named", NAMED)
    for text in ('Named("leg")', 'Attach(Named("leg"), All)', 'Geo(Named("leg"), +Z)'):
        assert str(parse_extractor(text)) == text
    assert explain(parse_extractor('Attach(Is(leg), Named("kn"))')) == (
        "the leg hulls that touch one of the hulls called kn…"
    )
    oriented = 'labels leg\n\norient +Z: Named("leg") -> Is(leg)\n'
    assert str(Program.parse(oriented)) == oriented
    found = enumerate_more_leaves(("Named",), ("leg",), "S+T+G", [table()])
    named = next(leaf for leaf in found if type(leaf).__name__ == "Named")
    assert Attach(Is("leg"), named) in found  # type: ignore[arg-type]
    assert Is("leg") not in found
    assert leaf_key(All(), {}) < leaf_key(named, {})


@pytest.mark.usefixtures("run")
def test_the_page_of_the_studio_has_its_sentence_and_its_arguments(install: Install) -> None:  # noqa: F811
    install("extractors", "Smaller", SMALLER)
    (view,) = [one for one in build_language_view().operators if one.name == "Smaller"]
    assert view.usage == "Smaller(base, share)"
    assert [argument.kind for argument in view.arguments] == ["base", "share"]
    (rule,) = check_text("Smaller(All, 0.05) => Delete").rules
    assert rule.sentence == "All hulls that are smaller than 5.0% of the asset are deleted."


@pytest.mark.usefixtures("run")
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Smaller(All) => Delete", r"p:1:12: expected `,`, not `\)`"),
        ("Smaller(Geo(All, +X), 0.1) => Delete", r"p:1:9: expected All or Is\(label\), not `Geo`"),
        ("Smaller(All, 2) => Delete", r"p:1:14: Smaller takes a share above 0 and at most 1 here, not `2`"),
        ("Geo(Smaller(All, 0.1), +X) => Delete", r"p:1:5: expected All or Is\(label\), not `Smaller`"),
        ("Smallr(All, 0.1) => Delete", r"Did you mean Smaller\?"),
    ],
)
def test_errors_have_their_place_and_remedy(install: Install, text: str, message: str) -> None:  # noqa: F811
    install("extractors", "Smaller", SMALLER)
    with pytest.raises(ProgramError, match=message):
        Program.parse(text, "p")


def test_a_mask_that_is_none_fails_by_asset(run: Run, install: Install) -> None:  # noqa: F811
    package = install("extractors", "Smaller", SMALLER.replace("return volumes <", "return volumes * "))
    Path("p.mf").write_text("Smaller(All, 0.1) => Delete\n")
    done = run("apply", "p.mf", "table.obj", "--out", "out", "--workers", "1", "--json")
    assert done.code == 1
    assert f"Smaller of the package {package} selects by float64 (6,), not by 6 booleans" in done.lines[0]["error"]


def test_a_name_that_no_package_has_is_refused_before_the_work(run: Run, install: Install) -> None:  # noqa: F811
    install("extractors", "Smaller", SMALLER)
    run("new", "home", "table.obj")
    done = run("synthesize", "home", "--with", "Smallr")
    assert done.code == 2
    assert "there is no extractor 'Smallr'" in done.err
    assert "Smaller" in done.err
    assert "extractors" not in (Path("home") / "meshforge.toml").read_text()
