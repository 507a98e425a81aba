"""What only tests and benchmarks call is found, and nothing else."""

from pathlib import Path

import pytest

from script.callers import find_uncalled
from script.structure import read_modules

SCRIPTS = 'scripts = {meshforge = "meshforge.a:main"}'


def uncalled(folder: Path, files: dict[str, str]) -> list[str]:
    """What is found in a tree of some files, by paths below `meshforge`; `main` of the module `a` is its command."""
    (folder / "pyproject.toml").write_text(f'[project]\nname = "meshforge"\n{SCRIPTS}\n')
    for name, text in {"src/meshforge/__init__.py": "", **files}.items():
        path = folder / name if "/" in name else folder / "src/meshforge" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    found = find_uncalled(read_modules(folder / "src"), read_modules(folder, "script"), folder)
    return [line.removeprefix("meshforge.").removesuffix(": only tests and benchmarks call it") for line in found]


def test_what_a_command_calls_in_its_module_or_by_an_import_is_used(tmp_path: Path) -> None:
    a = "from meshforge.b import f\nimport meshforge.b as b\ndef main(): f(), b.g(), h(C)\ndef h(x): ...\nclass C:...\n"
    assert uncalled(tmp_path, {"a.py": a, "b.py": "def f(): ...\ndef g(): ...\n"}) == []


def test_functions_and_classes_that_nothing_reads_are_found_with_all_that_only_they_call(tmp_path: Path) -> None:
    a = "def f(): return _g()\ndef _g(): return C()\nclass C:\n    def m(self): ...\ndef main(): ...\n"
    assert uncalled(tmp_path, {"a.py": a}) == ["a:f", "a:_g", "a:C"]


@pytest.mark.parametrize("caller", ["tests/test_a.py", "benchmark/speed.py", "script/draw.py"])
def test_tests_benchmarks_and_other_scripts_are_no_callers(tmp_path: Path, caller: str) -> None:
    assert uncalled(tmp_path, {"a.py": "def f(): ...\n", caller: "from meshforge.a import f\nf()\n"}) == ["a:f"]


def test_a_package_that_offers_a_name_does_not_call_it(tmp_path: Path) -> None:
    offer = 'from meshforge.p.b import f, g\n__all__ = ["f", "g"]\n'
    files = {"src/meshforge/p/__init__.py": offer, "src/meshforge/p/b.py": "def f(): ...\ndef g(): ...\n"}
    a = "from meshforge.p import f, g as other\ndef main(): other()\n"
    assert uncalled(tmp_path, {"a.py": a, **files}) == ["p.b:f"]


def test_the_names_of_the_python_interface_are_called_by_people(tmp_path: Path) -> None:
    a = "def f(): ...\nclass C:\n    def shown(self): ...\n    def hidden(self): ...\n"
    page = "Words: shown, hidden, g.\n```python\nmf.C().shown()\n```\n"
    files = {"src/meshforge/__init__.py": "from meshforge.a import C, f\n", "a.py": a, "docs/python.md": page}
    assert uncalled(tmp_path, files) == ["a:C.hidden"]


def test_a_method_or_property_is_used_where_any_attribute_of_its_name_is_read(tmp_path: Path) -> None:
    a = (
        "class C:\n    @property\n    def size(self): ...\n    @property\n    def idle(self): ...\n"
        "    def call(self): ...\n    def set(self): self.idle = 1\n    draw = show\n    print = show\n"
        "def show(c): return c.size\ndef main(c): C().call(); c.set(); c.draw()\n"
    )
    found = uncalled(tmp_path, {"a.py": a})
    assert found == ["a:C.print"]


def test_overrides_are_used_as_their_base_s_methods_are(tmp_path: Path) -> None:
    a = (
        "import threading\nfrom typing import Protocol\n"
        "class Base:\n    def called(self): ...\n    def idle(self): ...\n"
        "class Own(Base):\n    def called(self): ...\n    def idle(self): ...\n    def __add__(self, other): ...\n"
        "class Thread(threading.Thread):\n    def run(self): ...\nclass Other(Thread):\n    def start(self): ...\n"
        "class Told(Protocol):\n    def tell(self): ...\n"
        "def main(told: Told): Base().called(); return Own, Other\n"
    )
    assert uncalled(tmp_path, {"a.py": a}) == ["a:Base.idle", "a:Own.idle"]
