"""Programs: a vocabulary, an orientation and rules; parsed, printed, run, a label renamed in them."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

from meshforge.common import MeshForgeError, ProgramError
from meshforge.language import parse
from meshforge.language.actions.edit import Template, check_templates
from meshforge.language.arguments import show_number
from meshforge.language.extractors.base import Extractor, labels_of, rename_in_extractor
from meshforge.language.orient import Orient, rename_in_orient
from meshforge.language.print import CommentLines, Comments, Rule, attach_comments, show, show_rule
from meshforge.language.replay import Memo, Replay, RuleTrace, make_anew
from meshforge.language.text import Node, ProgramText, TreeReader, subtrees_of
from meshforge.language.words import check_declared, check_label, check_threshold, show_label
from meshforge.symbolic import SymbolicMesh, is_class_name

_MOST_ALIGNED = 60  # a longer extractor does not push the arrows of the other rules to the right


@dataclass(frozen=True, slots=True)
class HeaderComments:
    """The comments of the header lines, and those after the last statement."""

    labels: Comments = field(default=Comments())
    contact: Comments = field(default=Comments())
    extremity: Comments = field(default=Comments())
    orient: Comments = field(default=Comments())
    end: CommentLines = ()


@dataclass(frozen=True, eq=False, slots=True)
class RunResult:
    """The edited mesh in the incoming frame, the very same object where nothing changed, and a trace of every rule."""

    mesh: SymbolicMesh
    trace: tuple[RuleTrace, ...]


@dataclass(frozen=True, slots=True)
class Program:
    """A batch-editing program; a program without declared labels declares those it uses.

    contact, extremity: epsilon and delta where the program sets them; None takes the mesh's and 0.05.
    Raises ProgramError for a label that is used, but not declared, and for a threshold outside 0..1.
    """

    labels: tuple[str, ...] = ()
    orient: Orient | None = None
    rules: tuple[Rule, ...] = ()
    contact: float | None = None
    extremity: float | None = None
    comments: HeaderComments = field(default=HeaderComments(), compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "labels", tuple(self.labels) or self.labels_in_use)
        object.__setattr__(self, "rules", tuple(self.rules))
        for label in self.labels:
            check_label(label)
            if self.labels.count(label) > 1:
                raise ProgramError(f"the label {label!r} is declared twice")
        for label in self.labels_in_use:
            check_declared(label, self.labels)
        check_threshold("contact", self.contact)
        check_threshold("extremity", self.extremity)

    @property
    def labels_asked(self) -> tuple[str, ...]:
        """The labels that landmarks and extractors ask for, each once, in order of mention."""
        pairs = self.orient.pairs if self.orient else ()
        asked: list[Extractor] = [end for pair in pairs for end in (pair.start, pair.end)]
        asked += [rule.extractor for rule in self.rules]
        return tuple(dict.fromkeys(label for extractor in asked for label in labels_of(extractor)))

    @property
    def labels_in_use(self) -> tuple[str, ...]:
        """The labels asked for, then those that rules give to what they make."""
        made = [rule.label for rule in self.rules if rule.label is not None]
        return tuple(dict.fromkeys([*self.labels_asked, *made]))

    @property
    def templates(self) -> tuple[str, ...]:
        """The template files that the rules name, each once, in order of mention."""
        return tuple(dict.fromkeys(name for rule in self.rules for name in rule.action.templates))

    @staticmethod
    def parse(text: str, name: str = "program") -> "Program":
        """Return the program in a text. Raises ProgramError at `name:line:column`, with the line and a caret."""
        source = ProgramText(text.removeprefix("\ufeff").removesuffix("\n") + "\n", name)
        try:
            return _build_program(source, parse.parse_tree(source, "program"))
        except RecursionError:
            raise ProgramError("its extractors are nested too deep", where=name) from None

    @staticmethod
    def read(path: Path | str) -> "Program":
        """Return the program in a file. Raises ProgramError where it cannot be read or does not parse."""
        path = Path(path)
        try:
            return Program.parse(path.read_text(encoding="utf-8"), str(path))
        except OSError as error:
            raise ProgramError(f"the program cannot be read ({error.strerror})", where=str(path)) from None
        except UnicodeDecodeError:
            remedy = "Save it as UTF-8."
            raise ProgramError("the program is not text in UTF-8", where=str(path), remedy=remedy) from None

    def run(
        self,
        mesh: SymbolicMesh,
        templates: Mapping[str, Template] | None = None,
        *,
        selections: Mapping[int, Collection[str]] = MappingProxyType({}),
        memo: Memo = make_anew,
    ) -> RunResult:
        """Return the program's edit of a mesh, with a trace.

        selections: names of hulls that rules select on this mesh whatever their extractors do, by their numbers; memo:
        where many programs are run on the same mesh, keeps what each step made, for those that begin alike.
        Hulls that no rule touches come back as the same objects. Raises ProgramError, about the mesh's file where it
        has one: a missing template, no labels, a landmark that gives no direction; DemonstrationError for no hull of a
        name in `selections`; GeometryError for a hull that cannot be made.
        """
        templates = templates or {}
        try:
            check_templates(self.templates, templates)
            self.check_has_labels(mesh)
            *_, last = self.replay(mesh, templates, selections=selections, memo=memo)
            return RunResult(last.edited, last.trace)
        except MeshForgeError as error:
            raise error.at(str(mesh.asset.path)) if mesh.asset else error from None

    def replay(
        self,
        mesh: SymbolicMesh,
        templates: Mapping[str, Template],
        *,
        name: str = "",
        selections: Mapping[int, Collection[str]] = MappingProxyType({}),
        memo: Memo = make_anew,
    ) -> Iterator[Replay]:
        """Yield a mesh as each rule meets it, and after the last one; see `run` for the arguments and errors.

        name: how errors call the mesh.
        """
        current = Replay.begin(mesh, self.orient, self.contact, name=name, selections=selections, memo=memo)
        yield current
        for rule in self.rules:
            current = current.advance(rule, templates, self.extremity)
            yield current

    def check_has_labels(self, mesh: SymbolicMesh) -> None:
        """Raise ProgramError where it asks for labels and no hull has one."""
        if self.labels_asked and mesh.hulls and not any(hull.annotation for hull in mesh.hulls):
            remedy = "Label the asset first (meshforge label), or give its labels with --labels FILE."
            if all(map(is_class_name, self.labels_asked)):
                remedy = "Learning gives them to the assets of a project, by its demonstrations: meshforge synthesize"
            raise ProgramError("no labels, though the program asks for some", remedy=remedy)

    def __str__(self) -> str:
        return "".join(f"{line}\n" for line in _program_lines(self))


def rename_in_program(program: Program, old: str, new: str) -> Program:
    """Return the program with a label by another name; declared twice by that, it is declared once."""
    rules = (
        replace(
            rule,
            extractor=rename_in_extractor(rule.extractor, old, new),
            label=new if rule.label == old else rule.label,
        )
        for rule in program.rules
    )
    labels = dict.fromkeys(new if label == old else label for label in program.labels)
    orient = rename_in_orient(program.orient, old, new) if program.orient else None
    return replace(program, labels=tuple(labels), orient=orient, rules=tuple(rules))


def _program_lines(program: Program) -> Iterator[str]:
    """The lines: header, orientation and rules as paragraphs, then the comments at the end."""
    lines: list[str] = []
    for text, comments, paragraph in _statements(program):
        blank = paragraph and bool(lines)
        above = comments.above[1:] if comments.above[:1] == (None,) else comments.above
        if lines and (blank or above != comments.above):
            lines.append("")
        lines += _comment_lines(above)
        lines.append(f"{text}  #{comments.beside}" if comments.beside is not None else text)
    end = program.comments.end
    lines += _comment_lines(end if lines else end[1:] if end[:1] == (None,) else end)
    yield from lines


def _statements(program: Program) -> Iterator[tuple[str, Comments, bool]]:
    """Text, comments, and whether it begins a paragraph, of every statement in canonical order."""
    notes = program.comments
    if program.labels:
        yield f"labels {', '.join(map(show_label, program.labels))}", notes.labels, False
    if program.contact is not None:
        yield f"contact {show_number(program.contact)}", notes.contact, False
    if program.extremity is not None:
        yield f"extremity {show_number(program.extremity)}", notes.extremity, False
    if program.orient:
        yield show(program.orient), notes.orient, True
    widths = [len(show(rule.extractor)) for rule in program.rules]
    width = max((w for w in widths if w <= _MOST_ALIGNED), default=0)
    for k, rule in enumerate(program.rules):
        yield show_rule(rule, width), rule.comments, k == 0


def _comment_lines(lines: CommentLines) -> list[str]:
    return ["" if line is None else f"#{line}" for line in lines]


def _build_program(source: ProgramText, tree: Node) -> Program:
    statements = subtrees_of(tree)
    text = TreeReader(source)
    headers = parse.collect_headers(text, [node for node in statements if node.data != "rule"])
    labels = parse.build_labels(text, headers["labels"]) if "labels" in headers else ()
    text = TreeReader(source, labels)
    comments, end = attach_comments(source.text, [node.meta.line for node in statements])
    of = dict(zip(map(id, statements), comments, strict=True))
    return Program(
        labels,
        parse.build_orient(text, headers["orient"]) if "orient" in headers else None,
        tuple(parse.build_rule(text, node, of[id(node)]) for node in statements if node.data == "rule"),
        parse.build_threshold(text, headers.get("contact")),
        parse.build_threshold(text, headers.get("extremity")),
        HeaderComments(**{name: of[id(node)] for name, node in headers.items()}, end=end),
    )
