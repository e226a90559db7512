"""
What tests show about the objects that others may wait for: a future is done, a thread has ended.

``if not future.done(): await future`` waits; behind ``if future.done():`` the result is there, and
a loop that asks until the answer changes is a wait itself. The answer to such a question is an
``Answer``, through ``not``, ``and``, ``or``, names and functions; where a test has come out, what
it shows is kept in ``World.ready`` until the branches meet. Source: CPython 3.12,
``concurrent/futures/_base.py``, ``threading.py``, ``queue.py``.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence
from enum import Enum
from functools import reduce

from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown


class Word(Enum):
    """What is done to an object that others wait on."""

    SET = 'set'
    PUT = 'put'
    GET = 'get'
    DONE = 'done'
    RELEASE = 'release'
    ARRIVE = 'arrive'
    END = 'end'
    WRITE = 'write'
    OTHER = 'other'
    """Of what an expression does not stand for."""
    STORED = 'stored'
    """Perhaps: the run has stored data of that name, and has not waited since."""
    STALE = 'stale'
    """Perhaps: the run has waited since it stored data of that name."""


Facts = frozenset[tuple[Value, Word]]
NOTHING: Facts = frozenset()
_ASKED = 'the answer of what others change'


@dataclass(frozen=True)
class Implied:
    """
    What follows from the truth of a test.

    :param holds: what has surely happened where it is true, ``fails`` where it is false.
    :param makes: what may make it true when it happens, ``breaks`` false.
    :param knows: what has surely happened too where it is true, ``knows_not`` where it is false,
        though it takes more than that to make it so: what is full holds something.
    :param is_either: one of several objects is asked, depending on a branch.
    """

    holds: Facts = NOTHING
    fails: Facts = NOTHING
    makes: Facts = NOTHING
    breaks: Facts = NOTHING
    knows: Facts = NOTHING
    knows_not: Facts = NOTHING
    is_either: bool = False

    def negated(self) -> Implied:
        """The same of ``not``."""
        return Implied(
            holds=self.fails,
            fails=self.holds,
            makes=self.breaks,
            breaks=self.makes,
            knows=self.knows_not,
            knows_not=self.knows,
            is_either=self.is_either,
        )


class Answer(Mystery):
    """A truth that could not be followed, and what it shows about the objects that were asked."""

    __slots__ = ('implied',)

    def __init__(self, unknown: Unknown, text: str | ast.expr, implied: Implied) -> None:
        super().__init__(unknown, text)
        self.implied = implied


def answer(thing: Value, word: Word, call: Call, *, if_true: bool = True) -> Answer:
    """Whether ``word`` has happened to ``thing``, or whether it has not."""
    facts = frozenset({(thing, word)})
    implied = Implied(holds=facts, makes=facts)
    return Answer(
        Unknown(_ASKED, call.place), call.text or '', implied if if_true else implied.negated()
    )


def full(queue: Value, call: Call) -> Answer:
    """Whether ``queue`` has no room left; it holds something then."""
    got, put = (frozenset({(queue, word)}) for word in (Word.GET, Word.PUT))
    implied = Implied(fails=got, breaks=got, knows=put)
    return Answer(Unknown(_ASKED, call.place), call.text or '', implied)


def cancelled(future: Value, call: Call) -> Answer:
    """Whether ``future`` was cancelled, which makes it done."""
    implied = Implied(holds=frozenset({(future, Word.SET)}))
    return Answer(Unknown(_ASKED, call.place), call.text or '', implied)


def known_if_true(fact: tuple[Value, Word], call: Call) -> Answer:
    """A truth that nobody waits for, and what it shows."""
    implied = Implied(knows=frozenset({fact}))
    return Answer(Unknown('a transform at run time', call.place), call.text or '', implied)


def running(future: Value, call: Call) -> Answer:
    """Whether ``future`` is worked at just now."""
    implied = Implied(breaks=frozenset({(future, Word.SET)}))
    return Answer(Unknown(_ASKED, call.place), call.text or '', implied)


def implied_by(value: Value | None) -> Implied | None:
    """What ``value`` shows as a test; of one of several objects, that it is the one meant."""
    options = options_of(value) if value is not None else ()
    found = [option.implied for option in options if isinstance(option, Answer)]
    return reduce(_both, found) if found else None


def negated(value: Value, node: ast.expr) -> Answer | None:
    """The value of ``not``."""
    implied = implied_by(value)
    return None if implied is None else Answer(_unknown(value), node, implied.negated())


def joined(values: Sequence[Value], node: ast.BoolOp) -> Answer | None:
    """The value of ``and`` and ``or``, where nothing but truths stands in it."""
    if not any(implied_by(value) for value in values) or not all(map(_is_truth, values)):
        return None
    implied = _of_each(values, stops_on=isinstance(node.op, ast.Or))
    return Answer(_first(values), node, implied)


def of_items(items: Sequence[Value], call: Call, *, stops_on: bool) -> Answer | None:
    """The value of ``any(…)``, which the first truth stops, and of ``all(…)``."""
    if not any(implied_by(item) for item in items):
        return None
    return Answer(_first(items), call.text or '', _of_each(items, stops_on=stops_on))


def compared(op: ast.cmpop, left: Value, right: Value, node: ast.expr) -> Answer | None:
    """The value of ``future.done() is False``."""
    implied = implied_by(left)
    if implied is None or not isinstance(right, Const) or not isinstance(right.value, bool):
        return None
    is_same = isinstance(op, (ast.Is, ast.Eq))
    if not is_same and not isinstance(op, (ast.IsNot, ast.NotEq)):
        return None
    return Answer(_unknown(left), node, implied if is_same is right.value else implied.negated())


def of_all(ends: Iterable[Facts]) -> Facts:
    """What has happened however the branches were left, and what may have happened."""
    kept = list(ends)
    return frozenset.intersection(*kept).union(*map(perhaps, kept)) if kept else NOTHING


def perhaps(facts: Facts) -> Facts:
    """What one way to here is enough for."""
    return frozenset(fact for fact in facts if fact[1] is Word.STORED or fact[1] is Word.STALE)


def back_to(before: Facts, now: Facts) -> Facts:
    """What was sure before, where what came since may not have been met, or may."""
    return before | perhaps(now)


def _of_each(values: Sequence[Value], *, stops_on: bool) -> Implied:
    implied = [implied_by(value) or Implied() for value in values]
    return _all([each.negated() for each in implied]).negated() if stops_on else _all(implied)


def _all(implied: Sequence[Implied]) -> Implied:
    return Implied(
        holds=NOTHING.union(*(each.holds for each in implied)),
        fails=of_all(each.fails for each in implied),
        makes=NOTHING.union(*(each.makes for each in implied)),
        breaks=NOTHING.union(*(each.breaks for each in implied)),
        knows=NOTHING.union(*(each.knows for each in implied)),
        knows_not=of_all(each.knows_not for each in implied),
        is_either=any(each.is_either for each in implied),
    )


def _both(one: Implied, other: Implied) -> Implied:
    return Implied(
        holds=one.holds | other.holds,
        fails=one.fails | other.fails,
        makes=one.makes | other.makes,
        breaks=one.breaks | other.breaks,
        knows=one.knows & other.knows,
        knows_not=one.knows_not & other.knows_not,
        is_either=True,
    )


def _is_truth(value: Value) -> bool:
    return all(isinstance(option, (Mystery, Const)) for option in options_of(value))


def _unknown(value: Value) -> Unknown:
    return next(option.unknown for option in options_of(value) if isinstance(option, Mystery))


def _first(values: Sequence[Value]) -> Unknown:
    return _unknown(next(value for value in values if implied_by(value) is not None))
