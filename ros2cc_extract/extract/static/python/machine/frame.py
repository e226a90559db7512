"""One running function, class body or module, and how what is followed may be left early."""

from __future__ import annotations

import ast
from dataclasses import field

from ros2cc_extract.extract.static.program.text_queries import mangled
from ros2cc_extract.extract.static.python.machine.path_facts import Facts
from ros2cc_extract.extract.static.python.machine.store import Writes
from ros2cc_extract.extract.static.python.values.values import (
    Function,
    Module,
    Path,
    Scope,
    Value,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


class CannotCallError(Exception):
    """A call directly in the text of a ``try`` surely raises ``TypeError``."""


class BudgetError(Exception):
    """The program is too large to be followed to its end."""


@dataclass
class Frame:
    """
    One running function, class body or module.

    :param path: the undecided branches under which it began.
    :param many: what it yields any number of times, or perhaps not at all.
    :param breaks: what the branches that leave the running loop had written to own names.
    :param known_at_break: what has surely happened there, see ``World.ready``; the same of each
        ``return``.
    :param held: locks that were held at the first ``yield``.
    :param left: locks that are held at each ``return``, flags that were found down, and whether it
        turns down a goal.
    :param copies: own names that hold what other functions may have changed.
    :param sources: shared data that own names were computed from, while a callback is followed.
    :param continues: the same of the branches that go on with its next round.
    :param narrowed: names and attributes of which it was asked what they are instances of.
    :param statement: the one that was begun last.
    :param tests: undecided ones with the place of the first ``if``, whether that asks the
        opposite, and the options of the values that were asked.
    """

    scope: Scope
    function: Function | None = None
    results: list[Value] = field(default_factory=list)
    yields: list[Value] = field(default_factory=list)
    held: tuple[str, ...] = ()
    left: list[tuple[tuple[str, ...], frozenset[str], bool]] = field(default_factory=list)
    many: dict[Value, Value] = field(default_factory=dict)
    qualname: str = ''
    path: Path = ()
    breaks: list[Writes] = field(default_factory=list)
    known_at_break: list[Facts] = field(default_factory=list)
    known_at_return: list[Facts] = field(default_factory=list)
    continues: list[Writes] = field(default_factory=list)
    copies: frozenset[str] = frozenset()
    sources: dict[str, frozenset[str]] = field(default_factory=dict)
    narrowed: frozenset[str] = frozenset()
    statement: ast.stmt | None = None
    tests: dict[str, tuple[Place, bool, tuple[tuple[Value, ...], ...]]] = field(
        default_factory=dict
    )

    @property
    def module(self) -> Module:
        """The module whose text is running."""
        return self.scope.module

    def place(self, node: ast.AST) -> Place:
        """Where ``node`` stands, kept on the node: a tree belongs to one file."""
        notes = node.__dict__
        known: Place | None = notes.get('place')
        if known is None:
            line, column = notes.get('lineno', 0), notes.get('col_offset', -1) + 1
            known = notes['place'] = Place(self.scope.module.file, line, column)
        return known

    def end_of(self, node: ast.expr) -> Place:
        """Where ``node`` ends."""
        line, column = node.end_lineno or node.lineno, node.end_col_offset or node.col_offset
        return Place(self.scope.module.file, line, column)

    def attribute_name(self, name: str) -> str:
        """The attribute that ``name`` means in the text that is running."""
        return mangled(name, self._class_name()) if name.startswith('__') else name

    def _class_name(self) -> str | None:
        """Name of the innermost class around the running text."""
        for piece in reversed(self.qualname.removesuffix('.<locals>').split('.<locals>.')):
            names = piece.split('.')
            if self.function is None and names[-1]:
                return names[-1]
            if len(names) > 1:
                return names[-2]
        return None
