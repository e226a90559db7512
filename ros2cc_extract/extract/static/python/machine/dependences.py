"""
What a callback has read so far, and what it does because of that.

Kept while one callback is followed: which reads a test or a value rests on, which item of a
container is meant, and which objects are used rather than only looked at.
"""

from __future__ import annotations

import ast
from collections.abc import Container, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import field

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.values import NONE, Path, Value
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_IDENTITY = (ast.Is, ast.IsNot, ast.Eq, ast.NotEq)
_ORDER = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)


@dataclass(frozen=True)
class Asked:
    """
    A test, as far as it shows that code waits for a condition in time.

    :param names: of the data that it reads.
    :param holds: the locks that were held then, see ``lost_notifications.py``.
    :param is_open: its answer may rest on more.
    :param until: of a loop, the data until whose change it waits, where it rests on nothing else;
        ``is_of_several`` where one change may not be enough.
    """

    names: frozenset[str]
    holds: frozenset[tuple[str, int]]
    is_open: bool
    until: frozenset[str] = frozenset()
    is_of_several: bool = False


NOTHING_ASKED = Asked(frozenset(), frozenset(), is_open=False)


@dataclass
class Reading:
    """
    Notes on the reads of shared data.

    :param read: names that were read since the last question.
    :param flowing: names on which the value rests that is being stored.
    :param tests: names that a branch or an early return rests on, by the place of the test.
    :param items: the item that is meant, by the place of the container and its attribute.
    :param choices: the shared data because of which it is that item, in the same way.
    :param used: objects that are asked for more than being there, in the same way.
    :param asked_for: what a test only asks for its truth, or compares, in the same way.
    :param compared: what is only asked for whether it is still what the function knows.
    :param stored: the value that is being stored; ``replaced`` the one of an attribute before.
    :param is_whole: what is stored now is read and stored in one piece, see ``atomic_updates.py``.
    :param is_claim: it is a flag, put up right behind its test, see ``claims.py``.
    :param taken_from: arguments of the function that what is stored now was taken from.
    :param named: what the source names in that value.
    :param waited: where the value ends that is stored now, if it is waited for.
    :param value_end: where the value ends that is stored now.
    :param calls: how many calls there were.
    :param tested_at: how many there were before a test, by its place; ``read_at`` before the last
        read, by the name of what was read. ``begun_at``: how many functions of the program had
        begun before a test, and how many of them were over.
    :param refusing: names because of which a goal was turned down.
    :param asked: the tests of branches, by their place; ``loops`` those of the loops around.
    :param down: flags that were found down, by the step of the path on which they are.
    :param found: what tests have found of them there, see ``Access.found``.
    :param around: the loops around the tests that have found it, see ``World.laps``.
    :param passed: tests behind which the program is because it has not raised there; that leads
        to no step of the path.
    """

    read: set[str] = field(default_factory=set)
    flowing: frozenset[str] = frozenset()
    tests: dict[Place, frozenset[str]] = field(default_factory=dict)
    items: dict[tuple[Place, str], str] = field(default_factory=dict)
    choices: dict[tuple[Place, str], frozenset[str]] = field(default_factory=dict)
    used: set[tuple[Place, str]] = field(default_factory=set)
    asked_for: set[tuple[Place, str]] = field(default_factory=set)
    compared: set[tuple[Place, str]] = field(default_factory=set)
    refusing: set[str] = field(default_factory=set)
    stored: Value | None = None
    replaced: Value | None = None
    is_whole: bool = False
    is_claim: bool = False
    taken_from: frozenset[str] = frozenset()
    named: frozenset[str] = frozenset()
    waited: Place | None = None
    value_end: Place | None = None
    down: dict[tuple[Place, int], frozenset[str]] = field(default_factory=dict)
    found: dict[tuple[Place, int], dict[str, str]] = field(default_factory=dict)
    asked: dict[Place, Asked] = field(default_factory=dict)
    loops: list[Asked] = field(default_factory=list)
    calls: int = 0
    tested_at: dict[Place, int] = field(default_factory=dict)
    read_at: dict[str, int] = field(default_factory=dict)
    begun_at: dict[Place, tuple[int, int]] = field(default_factory=dict)
    around: dict[Place, object] = field(default_factory=dict)
    passed: Path = ()

    @contextmanager
    def in_loop(self, asked: Asked) -> Iterator[None]:
        """What is followed inside is done because of the test of a loop."""
        self.loops.append(asked)
        try:
            yield
        finally:
            self.loops.pop()

    def behind(self, path: Path) -> Path:
        """All the tests that have led to where the program is."""
        return (*path, *self.passed)

    @contextmanager
    def of(self, found: set[str]) -> Iterator[None]:
        """Put into ``found`` what is read inside."""
        before, self.read = self.read, set()
        try:
            yield
        finally:
            found |= self.read
            self.read |= before

    @contextmanager
    def apart(self) -> Iterator[None]:
        """What is read inside leads to no value that is used outside."""
        before = self.read
        self.read = set()
        try:
            yield
        finally:
            self.read = before

    def governs(self, name: str, path: Path) -> bool:
        """Whether a test of ``name`` has led to where the program is."""
        return any(name in self.tests.get(place, ()) for place, _ in self.behind(path))

    def leads_to(self, name: str, path: Path) -> bool:
        """The same, or a loop goes on because of it."""
        return self.governs(name, path) or any(name in asked.names for asked in self.loops)

    @property
    def fills_none(self) -> bool:
        """Whether an attribute that was None for sure gets something else."""
        return self.replaced == NONE and self.stored != NONE

    def found_of(self, name: str, path: Path, laps: object) -> str | None:
        """
        What tests of ``name`` have found, where nothing else of it matters any more.

        It is over where the code has stored something since, or may have in the round before of a
        loop behind the test.

        :param laps: as ``World.laps``.
        """
        if name in self.flowing:
            return None
        for step in reversed(self.behind(path)):
            known = self.found.get(step, {}).get(name)
            if known is not None and name in self.tests.get(step[0], ()):
                return known if self.around.get(step[0]) == laps else None
        return None

    def refuse(self, path: Path, found: Iterable[str]) -> None:
        """A goal is turned down here, after tests of what led here and of what was found."""
        self.refusing.update(found)
        for place, _ in self.behind(path):
            self.refusing |= self.tests.get(place, frozenset())

    def note_read(self, name: str) -> None:
        """Note that ``name`` is read here."""
        self.read.add(name)
        self.read_at[name] = self.calls

    def has_called_since_read(self, name: str) -> bool:
        """Whether something was called since ``name`` was read last."""
        return self.calls > self.read_at.get(name, self.calls)

    def has_called_since(self, name: str, path: Path) -> bool:
        """Whether something was called since ``name`` was tested last."""
        behind = self.behind(path)
        tests = (place for place, _ in behind if name in self.tests.get(place, ()))
        return self.calls > max((self.tested_at.get(place, 0) for place in tests), default=0)

    def has_run_since(self, name: str, path: Path, begun: int, over: int) -> bool:
        """
        Whether a function of the program has run since ``name`` was tested last.

        What only leads to here is no more than the text of its body would be in its place.
        """
        tests = [place for place, _ in self.behind(path) if name in self.tests.get(place, ())]
        known = [self.begun_at.get(place, (begun, over)) for place in tests]
        was_begun, was_over = max(known, default=(begun, over))
        return begun > was_begun and over > was_over

    def is_in_one_piece(self, name: str, path: Path) -> bool:
        """Whether no code writes ``name`` since it was read for what is stored now."""
        if not self.is_whole or (self.flowing and name not in self.flowing):
            return False
        return not self.governs(name, path) or not self.has_called_since(name, path)

    def forget(self, name: str, path: Path) -> None:
        """The callback has stored something itself: what it has read before decides no more."""
        for place, _ in self.behind(path):
            known = self.tests.get(place)
            if known is not None and name in known:
                self.tests[place] = known - {name}

    def note_item(self, container: ast.expr, item: str | None, place: Place) -> None:
        """``item`` of a container at ``place`` is meant, or one that is not known."""
        name = _name_of(container)
        if name is not None and item is not None:
            self.items[place, name] = item
        elif name is not None:
            self.items.pop((place, name), None)

    def note_choice(self, container: ast.expr, sources: frozenset[str], place: Place) -> None:
        """Which item of a container at ``place`` is meant was computed from ``sources``."""
        name = _name_of(container)
        if name is not None:
            self.choices[place, name] = sources

    def note_use(self, used: ast.expr, place: Place) -> None:
        """An attribute or item of ``used`` is asked for, or it is called."""
        name = _name_of(used)
        if name is not None:
            self.used.add((place, name))

    def note_operands(self, node: ast.BinOp | ast.Compare, file: str) -> None:
        """Operands that may not be ``None``: of arithmetic, of an order, and what is looked in."""
        for used in _operands(node):
            self.note_use(used, Place(file, used.lineno, used.col_offset + 1))

    def note_asked(self, test: ast.expr, file: str) -> None:
        """Note ``self.goal`` in a test of it: its value goes nowhere else."""
        for asked in _asked_in(test):
            name = _name_of(asked)
            if name is not None:
                self.asked_for.add((Place(file, asked.lineno, asked.col_offset + 1), name))

    def note_comparison(self, node: ast.Compare, file: str, own: Container[str]) -> None:
        """Note ``self.goal is goal``: code with this test expects others to store it."""
        left, right = node.left, node.comparators[0]
        if len(node.ops) > 1 or not isinstance(node.ops[0], _IDENTITY):
            return
        for asked, known in ((left, right), (right, left)):
            name = _name_of(asked)
            if name is not None and isinstance(known, ast.Name) and known.id in own:
                place = Place(file, asked.lineno, asked.col_offset + 1)
                self.compared.add((place, name))


def _asked_in(test: ast.expr) -> Iterator[ast.expr]:
    """The operands of a test, through ``not``, ``and``, ``or`` and comparisons."""
    if isinstance(test, ast.BoolOp):
        parts = test.values
    elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        parts = [test.operand]
    elif isinstance(test, ast.Compare):
        parts = [test.left, *test.comparators]
    else:
        yield test
        return
    for part in parts:
        yield from _asked_in(part)


def _operands(node: ast.BinOp | ast.Compare) -> Iterator[ast.expr]:
    if isinstance(node, ast.BinOp):
        # The right side of ``%`` may be what a text is made from, and ``|`` joins types.
        if not isinstance(node.op, ast.BitOr):
            yield node.left
        if not isinstance(node.op, (ast.BitOr, ast.Mod)):
            yield node.right
        return
    left = node.left
    for operator, right in zip(node.ops, node.comparators, strict=True):
        if isinstance(operator, _ORDER):
            yield from (left, right)
        elif isinstance(operator, (ast.In, ast.NotIn)):
            yield right
        left = right


def constant_key(key: ast.expr) -> str | None:
    """The text of a key that is equal to no other one of another text."""
    if not isinstance(key, ast.Constant) or type(key.value) not in (str, int):
        return None
    return repr(key.value)


def computed_from(value: ast.expr, sources: Mapping[str, frozenset[str]]) -> frozenset[str]:
    """The shared data behind the own names that stand in ``value``."""
    none = frozenset[str]()
    return none.union(*(sources.get(name, none) for name in names_in(value)))


def names_in(value: ast.expr) -> Iterable[str]:
    """The names that stand in an expression."""
    return noted_on(value, 'names_in', _names_in)


def _names_in(value: ast.expr) -> tuple[str, ...]:
    return tuple(part.id for part in walk(value) if isinstance(part, ast.Name))


def _name_of(node: ast.expr) -> str | None:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else None
