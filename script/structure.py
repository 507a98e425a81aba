"""Figures of the source's structure, and the limits that it keeps: `script/check` fails where one does not hold.

`python -m script.structure` names what breaks a limit; with --figures it prints every figure, too.
"""

from __future__ import annotations

import ast
import re
import statistics
import sys
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from script.callers import find_uncalled
from script.stubs import read_offers

SOURCE = Path(__file__).resolve().parents[1] / "src"
ROOT = "meshforge"
FILES, LINES, IMPORT_SHARE, PARAMETERS = 445, 71_540, 0.075, 8
TEST_LINES, PAGE_LINES = 57_850, 21_950
DEPTH = {"formats": 3, "studio": 3}
"""Levels of packages below `meshforge`; two where none is given."""
MANY_PARAMETERS = frozenset(  # what people ask of a picture and of a preparation, all with defaults
    {"meshforge.rendering.picture:render", "meshforge.project.prepare:decompose"}
    | {"meshforge.batch.preparation.decompose:decompose_asset"}
)
"""Functions that may take more than PARAMETERS parameters, as `module:function`."""
IRREGULAR = frozenset(
    re.findall(
        r"\w+",
        """
told said met given begun found made kept shown known taken held written drawn done gone seen left lost meant sent
built bent led chosen torn worn hidden broken frozen heard brought bought thought caught felt dealt lent spent won
struck stuck hung grown thrown risen driven spoken forgotten eaten fallen beaten understood got gotten sought taught
""",
    )
)
NO_PARTICIPLE = frozenset(
    re.findall(
        r"\w+",
        """
need seed feed embed exceed speed bed red shed proceed succeed breed string ring king bring thing during spring
wing swing nothing anything everything something ceiling heading meaning setting building warning rating reading
mapping encoding binding padding ordering spacing listing bounding finding rendering labeling
learning ranked relabeling coupling pending missing finished
""",
    )
)
"""Words that only look like participles, and nouns of the field (a candidate program is a reading, as in the paper)."""
NOUNS = frozenset(
    {"scaling", "tuning", "asking", "moving", "opening", "relearning", "scrolling", "spanning"}
    | {"writing_desk", "drafting_table", "serving_table"}
)
"""Parts of `script/bench`, and tables by their names in furniture."""
OUTCOMES = frozenset(
    {
        "Edited",
        "Held",
        "Unchanged",
        "Skipped",
        "Failed",
        "Completed",
        "Found",
        "TimedOut",
        "Unfinished",
        "Superseded",
        "StoppedError",
    }
)
"""Classes that may be adjectives: each is one way that a thing can end."""


@dataclass(frozen=True)
class Module:
    """A parsed source file."""

    name: str
    path: Path

    @cached_property
    def text(self) -> str:
        return self.path.read_text(encoding="utf-8")

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.text)

    @property
    def package(self) -> str:
        """The package of the first level that the module is in."""
        return ".".join(self.name.split(".")[:2])

    @property
    def depth(self) -> int:
        """Packages below `meshforge` that the module lies in."""
        folders = len(self.path.relative_to(SOURCE / ROOT).parts) - 1
        return folders

    @cached_property
    def statements(self) -> list[ast.Import | ast.ImportFrom]:
        """All import statements, lazy and type-only ones among them."""
        return [node for node in ast.walk(self.tree) if isinstance(node, ast.Import | ast.ImportFrom)]

    @cached_property
    def imports(self) -> list[ast.Import | ast.ImportFrom]:
        """All import statements, and what the module imports when it is first used."""
        return [*self.statements, *read_offers(self.tree, self.name)]

    def functions(self) -> Iterator[tuple[str, ast.FunctionDef | ast.AsyncFunctionDef]]:
        """Functions and methods with their qualified names; not those within functions."""
        for node in self.tree.body:
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                yield node.name, node
            elif isinstance(node, ast.ClassDef):
                own = (item for item in node.body if isinstance(item, ast.FunctionDef | ast.AsyncFunctionDef))
                yield from ((f"{node.name}.{item.name}", item) for item in own)

    def classes(self) -> list[str]:
        """The names of classes at the top level."""
        return [node.name for node in self.tree.body if isinstance(node, ast.ClassDef)]


def read_modules(base: Path = SOURCE, root: str = ROOT) -> dict[str, Module]:
    """All modules below a package, `src/meshforge` at first, by dotted name; a package's is that of its `__init__`."""
    found = {}
    for path in sorted((base / root).rglob("*.py")):
        name = ".".join(path.relative_to(base).with_suffix("").parts).removesuffix(".__init__")
        found[name] = Module(name, path)
    return found


def import_graph(modules: dict[str, Module]) -> dict[str, set[str]]:
    """Which modules each module imports, lazy and type-only imports counted."""
    graph: dict[str, set[str]] = {name: set() for name in modules}
    for name, module in modules.items():
        for node in module.imports:
            names = [alias.name for alias in node.names]
            if isinstance(node, ast.ImportFrom):
                base = node.module or ""
                names = [f"{base}.{own}" if f"{base}.{own}" in modules else base for own in names]
            graph[name] |= {own for own in names if own in modules and own != name}
    return graph


def find_cycles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Modules that import each other in a circle, one list for each circle (strongly connected components)."""
    nodes = sorted(graph)
    place = {name: k for k, name in enumerate(nodes)}
    links = [(place[name], place[other]) for name in nodes for other in sorted(graph[name])]
    rows, columns = zip(*links, strict=True) if links else ((), ())
    matrix = coo_array((np.ones(len(links)), (rows, columns)), (len(nodes), len(nodes)))
    count, component = connected_components(matrix, connection="strong")
    circles = [[name for name, own in zip(nodes, component, strict=True) if own == k] for k in range(count)]
    return sorted(circle for circle in circles if len(circle) > 1)


def is_participle(name: str) -> bool:
    """Whether the first word of a name is a participle or a gerund."""
    word = re.split(r"_|(?<=[a-z0-9])(?=[A-Z])", name.strip("_"))[0].lower()
    if word in NO_PARTICIPLE or name in NOUNS:
        return False
    return word in IRREGULAR or (len(word) > 4 and word.endswith(("ed", "ing")))


def count_parameters(node: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """The parameters of a function, without `self` and `cls`."""
    arguments = node.args
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
    return len([name for name in names if name not in ("self", "cls")])


def is_command(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    """Whether a function is a command of Typer's, whose parameters are the command's options."""
    return any("typer." in ast.unparse(item.annotation) for item in node.args.args if item.annotation)


def is_property(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    """Whether a method is read like an attribute."""
    return any(ast.unparse(item).split(".")[-1] in ("property", "cached_property") for item in node.decorator_list)


def find_participles(modules: dict[str, Module]) -> list[str]:
    """Functions, methods, classes and modules whose names begin with a participle; properties are attributes."""
    found = [name for name in modules if is_participle(name.split(".")[-1])]
    for name, module in modules.items():
        found += [f"{name}:{own}" for own in module.classes() if is_participle(own) and own not in OUTCOMES]
        found += [
            f"{name}:{own}"
            for own, node in module.functions()
            if is_participle(own.split(".")[-1]) and not is_property(node)
        ]
    return found


def find_homonyms(modules: dict[str, Module]) -> list[str]:
    """Public classes of one name in several packages."""
    homes = defaultdict(set)
    for module in modules.values():
        for name in module.classes():
            if not name.startswith("_"):
                homes[name].add(module.package)
    return [f"{name}: {', '.join(sorted(where))}" for name, where in sorted(homes.items()) if len(where) > 1]


def find_long_signatures(modules: dict[str, Module]) -> list[str]:
    """Functions of more than PARAMETERS parameters, commands left out."""
    return [
        f"{name}:{own} takes {count_parameters(node)} parameters"
        for name, module in modules.items()
        for own, node in module.functions()
        if count_parameters(node) > PARAMETERS and not is_command(node) and f"{name}:{own}" not in MANY_PARAMETERS
    ]


def find_silent_lazy_imports(modules: dict[str, Module]) -> list[str]:
    """Imports within functions that do not say why they are lazy, as `# lazy: REASON` on their first line."""
    found = []
    for name, module in modules.items():
        lines = module.text.splitlines()
        lazy = {
            item.lineno
            for node in ast.walk(module.tree)
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            for item in ast.walk(node)
            if isinstance(item, ast.Import | ast.ImportFrom)
        }
        found += [
            f"{name}, line {line}: a lazy import without `# lazy: REASON`"
            for line in sorted(lazy)
            if "# lazy: " not in lines[line - 1]
        ]
    return found


def count_test_lines(base: Path) -> int:
    """Return the lines of the tests' Python."""
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in (base / "tests").rglob("*.py"))


def count_page_lines(base: Path) -> int:
    """Return the lines of the page's TypeScript, without its tests and the types that are generated."""
    paths = [path for path in (base / "web/src").rglob("*.ts*") if ".test" not in path.name and path.name != "wire.ts"]
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def main(words: list[str]) -> int:
    """Print the figures where they are asked for, and every limit that does not hold; 1 where one does not."""
    modules = read_modules()
    scripts = read_modules(SOURCE.parent, "script")
    tools = read_modules(SOURCE.parent, "benchmark") | scripts
    sizes = {name: len(module.text.splitlines()) for name, module in modules.items()}
    lines = sum(sizes.values())
    imports = sum((node.end_lineno or 0) - node.lineno + 1 for module in modules.values() for node in module.statements)
    cycles = [f"cycle of {len(own)}: {', '.join(own)}" for own in find_cycles(import_graph(modules))]
    deep = [name for name, module in modules.items() if module.depth > DEPTH.get(module.package.split(".")[-1], 2)]
    found = {
        "cycles": cycles,
        "packages too deep": deep,
        f"functions of more than {PARAMETERS} parameters": find_long_signatures(modules),
        "public classes of one name in several packages": find_homonyms(modules),
        "participles as names": find_participles(modules | tools),
        "lazy imports without a reason": find_silent_lazy_imports(modules),
        "names that only tests and benchmarks call": find_uncalled(modules, scripts, SOURCE.parent),
    }
    broken = [line for own in found.values() for line in own]
    test_lines, page_lines = count_test_lines(SOURCE.parent), count_page_lines(SOURCE.parent)
    limits = (
        *((len(modules), FILES, "files"), (lines, LINES, "lines"), (imports / lines, IMPORT_SHARE, "import share")),
        *((test_lines, TEST_LINES, "lines of tests"), (page_lines, PAGE_LINES, "lines of the page")),
    )
    broken += [f"{value:,.3g} {what}, {limit:,} at most" for value, limit, what in limits if value > limit]
    if "--figures" in words:
        functions = [node for module in modules.values() for _, node in module.functions()]
        lengths = sorted((node.end_lineno or 0) - node.lineno + 1 for node in functions)
        print(f"files {len(modules)}, lines {lines:,}, median file {statistics.median(sizes.values()):.0f} lines")
        small, big = sum(size < 40 for size in sizes.values()), sum(size > 300 for size in sizes.values())
        print(f"lines of tests {test_lines:,}, of the page without tests and generated files {page_lines:,}")
        print(f"files under 40 lines {small}, over 300 {big}")
        print(f"lines of imports {imports:,}, {imports / lines:.1%} of all")
        tail = lengths[len(lengths) * 95 // 100]
        print(f"functions {len(functions):,}, median {statistics.median(lengths):.0f} lines, 95th percentile {tail}")
        print(f"folders {len({module.path.parent for module in modules.values()})}")
        print("\n".join(f"{what} {len(own)}" for what, own in found.items()))
    else:
        print("\n".join(broken), file=sys.stderr)
    return int(bool(broken))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
