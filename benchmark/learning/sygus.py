"""cvc5 as a rival: the search for one rule's extractor stated as SyGuS, over the truth values of the leaf extractors.

Plainly stated: one Boolean variable a leaf, one constraint a demonstrated hull, set operators as connectives. cvc5
prefers few connectives, and does not know that an `Attach` has more nodes than an `Is`: what it finds selects what
was shown, and need not be the smallest extractor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any

from meshforge.language import EXTREMITY, All, Diff, Extractor, Intersect, Leaf, Union, select_mask
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Layers
from meshforge.synthesis.search.terms import enumerate_leaves


@dataclass(frozen=True, slots=True)
class Problem:
    """What cvc5 is told: leaves, and for each demonstrated hull whether each leaf selects it and whether it was shown.

    Leaves that select all demonstrated hulls or none are left out, but for `All`, which says `true`.
    """

    leaves: tuple[Leaf, ...]
    rows: tuple[tuple[tuple[bool, ...], bool], ...]


def cvc5_problem(
    examples: Sequence[Example],
    vocabulary: Sequence[str],
    extremity: float = EXTREMITY,
    seconds: float = 60.0,
    layers: Layers = "S+T+G",
) -> Callable[[], Extractor | None]:
    """A call, for once, that lets cvc5 search: an extractor that selects what was shown, or None if it found none.

    seconds: after so long the call ends. cvc5 runs in a process of its own, since it cannot be interrupted: its
    options `tlimit` and `tlimit-per` do not end a search (cvc5 1.4.2: 5 s set, 75 s taken). The process is started
    and told the problem here, so that the call takes the time of the search. Raises ImportError without cvc5.
    """
    import cvc5  # noqa: F401 (fails here rather than in the other process)

    context = get_context("forkserver")
    context.set_forkserver_preload(["cvc5", __name__])  # else every process imports them anew
    here, there = context.Pipe()
    process = context.Process(
        target=_serve, args=(there, state_problem(examples, vocabulary, extremity, layers)), daemon=True
    )
    process.start()
    there.close()
    here.recv()  # it is ready

    def solve() -> Extractor | None:
        try:
            here.send("solve")
            return here.recv() if here.poll(seconds) else None
        except EOFError:  # cvc5 took its process down
            return None
        finally:
            process.kill()
            process.join()
            process.close()
            here.close()

    return solve


def state_problem(
    examples: Sequence[Example], vocabulary: Sequence[str], extremity: float = EXTREMITY, layers: Layers = "S+T+G"
) -> Problem:
    """The problem of a rule, as truth values."""
    columns = {leaf: _column(leaf, examples, extremity) for leaf in enumerate_leaves(tuple(vocabulary), layers)}
    telling = {leaf: column for leaf, column in columns.items() if len(set(column)) > 1 or leaf == All()}
    shown = [bool(e.selection >> hull & 1) for e in examples for hull in range(len(e.mesh.hulls))]
    rows = zip(zip(*telling.values(), strict=True), shown, strict=True)
    return Problem(tuple(telling), tuple(rows))


def _column(leaf: Leaf, examples: Sequence[Example], extremity: float) -> list[bool]:
    masks = [(select_mask(leaf, example.mesh, extremity), len(example.mesh.hulls)) for example in examples]
    return [bool(mask >> hull & 1) for mask, hulls in masks for hull in range(hulls)]


def _serve(pipe: Connection, problem: Problem) -> None:
    """The other process: states the problem, waits for the word, and answers."""
    search = _prepare(problem)
    try:
        pipe.send("ready")
        pipe.recv()
    except (EOFError, ConnectionError):  # nobody asks any more
        return
    pipe.send(search())


def _prepare(problem: Problem) -> Callable[[], Extractor | None]:
    import cvc5
    from cvc5 import Kind

    terms = cvc5.TermManager()
    solver = cvc5.Solver(terms)
    solver.setOption("sygus", "true")
    solver.setOption("incremental", "false")
    solver.setLogic("ALL")
    boolean = terms.getBooleanSort()
    variables = [terms.mkVar(boolean, f"leaf{k}") for k in range(len(problem.leaves))]
    function = solver.synthFun("selected", variables, boolean, _grammar(solver, terms, variables))
    for values, shown in problem.rows:
        applied = terms.mkTerm(Kind.APPLY_UF, function, *map(terms.mkBoolean, values))
        solver.addSygusConstraint(applied if shown else terms.mkTerm(Kind.NOT, applied))

    def search() -> Extractor | None:
        if not solver.checkSynth().hasSolution():
            return None
        parameters, body = solver.getSynthSolution(function)
        return _extractor(body, dict(zip(parameters, problem.leaves, strict=True)))

    return search


def _grammar(solver: Any, terms: Any, variables: Sequence[Any]) -> Any:
    """Variables, and of two selections: either, both, or one without the other."""
    from cvc5 import Kind

    start = terms.mkVar(terms.getBooleanSort(), "Extractor")
    grammar = solver.mkGrammar(variables, [start])
    without = terms.mkTerm(Kind.AND, start, terms.mkTerm(Kind.NOT, start))
    grammar.addRules(
        start, [*variables, terms.mkTerm(Kind.OR, start, start), terms.mkTerm(Kind.AND, start, start), without]
    )
    return grammar


def _extractor(term: Any, leaf_of: Mapping[Any, Leaf]) -> Extractor:
    """The extractor that a solution of the grammar stands for; nested connectives may have come back as one."""
    from cvc5 import Kind

    if term in leaf_of:
        return leaf_of[term]
    if term.getKind() == Kind.OR:
        return reduce(Union, (_extractor(part, leaf_of) for part in term))
    if term.getKind() != Kind.AND:
        raise ValueError(f"cvc5 left the grammar: {term}")
    kept = [_extractor(part, leaf_of) for part in term if part.getKind() != Kind.NOT]
    taken = [_extractor(part[0], leaf_of) for part in term if part.getKind() == Kind.NOT]
    return reduce(Diff, taken, reduce(Intersect, kept))
