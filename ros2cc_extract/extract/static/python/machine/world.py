"""
What one run of a program leaves behind, as far as Python itself goes.

Records are mutable while the run goes on. Models of more than the language derive from it: what
runs concurrently in ``concurrency/machine/state.py``, the model of a library in its own.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import field
from enum import Enum
from typing import Any, TypeVar

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.extract.static.python.machine.dependences import Reading
from ros2cc_extract.extract.static.python.machine.path_facts import Facts, Implied, Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer, EffectLog
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Const,
    Function,
    Heaped,
    Instance,
    Mystery,
    Path,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act
from ros2cc_extract.spec.model import When


class AccessKind(Enum):
    """How a callback touches shared state; an update needs the old value.

    One in place is a single operation on the object: ``append``, ``d[k] = v``, ``del d[k]``.
    """

    READ = 'read'
    WRITE = 'write'
    UPDATE = 'update'
    UPDATE_IN_PLACE = 'update in place'
    WITHIN = 'change of something in it'


@dataclass(frozen=True)
class Cut:
    """
    Why something may be missing from the units.

    :param classes: those whose methods were running then.
    """

    reason: str
    place: Place
    classes: frozenset[Class] = frozenset()


Effect = TypeVar('Effect', Access, Act, Cut)

ITSELF = '(itself)'
"""Of a change of a collection: it is computed from what is in it."""
# A loop that is unrolled meets the same effect again and again.
RECENT = 40


def note_once(noted: list[Effect], effect: Effect) -> None:
    """Note ``effect`` unless it has just been noted."""
    # Ten times as fast as the comparison of dataclasses, which makes tuples first.
    fields = effect.__dict__
    if not any(fields == other.__dict__ for other in noted[-RECENT:]):
        noted.append(effect)


@dataclass
class World:
    """
    One run.

    :param settled_now: attributes that no other code changes, so that they hold what is stored.
    :param current: the callback that is followed; ``activity`` the thread, or the part of the
        main program.
    :param path: the undecided branches we are in.
    :param count: how often what is made now is made (loops).
    :param is_program: it is run from an entry, so that nothing happens before its set-up.
    :param open_loops: how many loops with an unknown number of rounds are followed; ``loop_depth``
        how many functions were running when the last of them began; ``laps`` has one object for
        each loop that is followed now, of any number of rounds.
    :param ready: what has surely happened to objects that others may wait for, see
        ``path_facts.py``.
    :param picked: what had happened to items for which they were put into a collection, by its
        serial number.
    :param skipped_if: of a branch, what has surely happened where it is not taken.
    :param called: every function that was followed, by the identity of its statement.
    :param apart: what lies beside an object in a collection, both by their identities, see
        ``note_apart``; and the object itself, so that no other one gets its identity.
    :param handed: functions that code which is not scanned has, where and by what name, and why
        that code is not known.
    :param escaped_to_unknown: functions, by their text, that were followed as unknown code's, and
        ``called_later`` those that such functions were the first to call.
    :param subclasses: the direct ones of each class, in the order of their definition.
    :param made_of: how many instances there are of each class.
    :param followed_later: how many methods of each class were followed without a caller.
    :param settled: instances in which nothing was left to follow, with a stamp of that time.
    :param without_caller: the objects on which functions without a known caller were followed.
    :param yielding: the last generator that ran, with the locks that it keeps while it yields.
    :param one_by_one: whoever takes the items of the generator that runs takes one at a time.
    :param handing_on: the same of the items that are taken now: they are handed on one by one.
    :param turning: the generator that runs gives its items to who runs the coroutine.
    :param computed_name: where an object has got functions under names that are not known.
    :param intercepts: some class has an own ``__getattribute__``.
    :param first_yield: where the generator that runs stops, if nothing was taken from it yet.
    :param looking: the properties that are running, by owner and name.
    :param unset_globals: values of globals that known code only sets to ``None``, by file, name.
    :param same_unknowns: arguments of unknown callers that one attribute holds in turn.
    :param reading: what the callback that is followed has read.
    :param times: how often a loop does what is followed once, where that is known.
    :param round: which rounds of the loops around it are followed, where that distinguishes them;
        a negative number where the loop may be left before.
    :param iterating: class of the collection that a loop begins to go over.
    :param by_local: what is noted is done by a local name, which no other code clears.
    :param parts: what was made while an object was set up, by the identity of the object.
    :param moves: what the call does to a collection that follows, see ``Access``.
    :param given_from: the data that the call computes its change from, or ``ITSELF``.
    :param only_data: what is followed shows what it reads and writes, and nothing else.
    :param refilling: an item is stored under a key that the dictionary surely has.
    :param assumed: the rule by which the running loop is assumed to go over these items.
    :param stopped: this branch of the program has ended.
    :param trees: the text of every module that was run; ``files`` with the names of its file.
    :param changing: how often a callback has read what other functions may change.
    :param unset: how often one has read ``None`` where other functions put something.
    :param lacking: attributes that callbacks asked for before they were set, and (without
        a name) collections before an object was put in.
    :param missing: open tests on whether something is there yet.
    :param again: the running callback is followed once more; what it makes, it has made then.
    :param stored: what each attribute was ever assigned, by the place of that.
    :param stored_late: those that have got another value than the set-up gave them, or when others
        were at work already.
    :param trying: running calls and open branches directly in a ``try`` for a ``TypeError``.
    :param caught: the exceptions that each ``try`` around catches, outermost first, as written.
    :param caught_imports: of parts of libraries, whether each import of it is in such a ``try``.
    :param met: the objects that the running callback found in what others assign.
    :param met_by: the same of each callback that was followed, by the identity of its entity.
    :param rounds: how often it was followed again for others.
    :param tested: the value of the last test.
    :param conditions: of a branch that no default leads to, what setting does.
    :param plain: whether a function works on plain data alone, by the identity of its statement.
    :param plain_of: how many modules that was asked of.
    :param spent: the steps that such calls have taken, by the same, and under 0 of all.
    :param outside_objects: results of code that is not followed, except plain data; these objects
        may change by themselves.
    :param literals: constants that are stored by their own text, by the place they are stored to.
    :param handed_over: collections that such code was given.
    :param seen_outside: objects of the program that it was given, by their identity.
    :param doubted: classes and functions behind code that is not scanned, and what that is.
    :param described: attributes for which some class has an object with a method of its own.
    :param doubted_calls: how often these were called.
    """

    path: Path = ()
    count: int | Unknown = 1
    when: When = When.START
    is_program: bool = False
    stopped: bool = False
    assumed: str | None = None
    effects: EffectLog | None = None
    reading: Reading = field(default_factory=Reading)
    current: Doer | None = None
    open_loops: int = 0
    loop_depth: int = 0
    laps: tuple[object, ...] = ()
    picked: dict[int, frozenset[tuple[Value, Word]]] = field(default_factory=dict)
    skipped_if: dict[tuple[Place, int], frozenset[tuple[Value, Word]]] = field(
        default_factory=dict
    )
    ready: frozenset[tuple[Value, Word]] = frozenset()
    kept_inside: dict[int, Place] = field(default_factory=dict)
    chain: tuple[Place, ...] = ()
    held: tuple[str, ...] = ()
    yielding: tuple[Value, tuple[str, ...]] | None = None
    one_by_one: bool = False
    handing_on: bool = False
    turning: bool = False
    intercepts: bool = False
    computed_name: Place | None = None
    first_yield: ast.expr | None = None
    diagnostics: list[Diagnostic] = field(default_factory=list)
    called: dict[int, Function] = field(default_factory=dict)
    apart: dict[int, dict[int, Value]] = field(default_factory=dict)
    without_caller: dict[int, set[int]] = field(default_factory=dict)
    decorated: list[Function] = field(default_factory=list)
    decorated_classes: list[Class] = field(default_factory=list)
    escaped: list[tuple[Value, Place]] = field(default_factory=list)
    handed: list[tuple[Value, Place, str, str]] = field(default_factory=list)
    escaped_to_unknown: set[int] = field(default_factory=set)
    called_later: set[int] = field(default_factory=set)
    instances: list[Instance] = field(default_factory=list)
    subclasses: dict[Class, list[Class]] = field(default_factory=dict)
    made_of: Counter[Class] = field(default_factory=Counter)
    followed_later: Counter[Value] = field(default_factory=Counter)
    settled: dict[int, int] = field(default_factory=dict)
    times: int = 1
    round: tuple[int, ...] = ()
    iterating: str | None = None
    by_local: bool = False
    refilling: bool = False
    moves: str | None = None
    only_data: bool = False
    given_from: frozenset[str] = frozenset()
    looking: tuple[tuple[int, str], ...] = ()
    made_by_looking: dict[object, Instance] = field(default_factory=dict)
    unset_globals: dict[tuple[str, str], Mystery] = field(default_factory=dict)
    same_unknowns: dict[Unknown, Mystery] = field(default_factory=dict)
    kept: list[Value] = field(default_factory=list)
    callback_path: Path = ()
    cut: list[Cut] = field(default_factory=list)
    made_in_callbacks: dict[object, Instance] = field(default_factory=dict)
    trees: list[ast.Module] = field(default_factory=list)
    files: list[tuple[ast.Module, str]] = field(default_factory=list)
    changing: int = 0
    unset: int = 0
    lacking: list[tuple[Heaped, str | None]] = field(default_factory=list)
    missing: set[Place] = field(default_factory=set)
    again: bool = False
    made_then: dict[object, Instance] = field(default_factory=dict)
    parts: dict[int, list[Instance]] = field(default_factory=dict)
    stored: dict[tuple[Value, str], dict[Place, Value]] = field(default_factory=dict)
    stored_late: set[tuple[Value, str]] = field(default_factory=set)
    trying: tuple[int, int] | None = None
    caught: tuple[frozenset[str], ...] = ()
    caught_imports: dict[str, bool] = field(default_factory=dict)
    met: dict[tuple[Heaped, str], frozenset[object]] = field(default_factory=dict)
    met_by: dict[int, dict[tuple[Heaped, str], frozenset[object]]] = field(default_factory=dict)
    rounds: Counter[int] = field(default_factory=Counter)
    tested: Value | None = None
    conditions: dict[tuple[Place, int], str] = field(default_factory=dict)
    plain: dict[int, bool] = field(default_factory=dict)
    plain_of: int = 0
    spent: Counter[int] = field(default_factory=Counter)
    outside_objects: set[Unknown] = field(default_factory=set)
    literals: dict[Place, Any] = field(default_factory=dict)
    handed_over: dict[Value, Unknown] = field(default_factory=dict)
    seen_outside: set[int] = field(default_factory=set)
    doubted: dict[Value, str] = field(default_factory=dict)
    doubted_calls: Counter[Value] = field(default_factory=Counter)
    activity: Doer | None = None
    settled_now: frozenset[tuple[Instance, str]] = frozenset()
    described: set[str] = field(default_factory=set)

    @property
    def in_callback(self) -> bool:
        """Whether a callback is followed, and no thread that it starts."""
        return self.effects is not None and self.activity is None

    @property
    def has_let_others_run(self) -> bool:
        """Whether the set-up has let callbacks run, which may have changed what it has stored."""
        return False

    @property
    def is_beside_others(self) -> bool:
        """Whether the set-up is followed, and a thread may be at work beside it."""
        return False

    def left_before(self) -> frozenset[Place]:
        """The branches that end a loop or function, if nothing else leads here conditionally."""
        own = self.path[len(self.callback_path) :]
        return frozenset(at for at, _ in own) if all(arm == -1 for _, arm in own) else frozenset()

    def note_done(self, name: object, place: Place) -> None:
        """Something that may end a wait is done to ``name``, perhaps on a branch or in a loop."""
        if self.effects is None:
            return
        is_open = self.path != self.callback_path
        self.effects.written.setdefault((name, place), (self.effects.behind, is_open))
        if self.open_loops:
            self.effects.looped.add((name, place))

    def note_apart(self, item: Value, items: Iterable[Value]) -> None:
        """An item is taken from a collection by its key: the others are other objects."""
        if isinstance(item, Instance):
            others = {id(each): each for each in items if each is not item}
            self.apart.setdefault(id(item), {id(None): item}).update(others)

    def note_stored(self, name: str, stack: Sequence[Function]) -> None:
        """The run has stored data itself: it may rely on that until it waits."""
        if self.effects is not None:
            self.effects.storers.setdefault(name, set()).add(tuple(stack))
        self.ready -= {(Const(name), Word.STALE)}
        self._note_perhaps(frozenset({(Const(name), Word.STORED)}))

    def note_waited(self, way: object) -> None:
        """The run waits: others may store what it has stored."""
        if self.effects is not None:
            self.effects.behind = way
        self.let_others_store()

    def let_others_store(self) -> None:
        """What the run has stored by now may be another run's from here on."""
        stored = frozenset(fact for fact in self.ready if fact[1] is Word.STORED)
        self.ready -= stored
        self._note_perhaps(frozenset((name, Word.STALE) for name, _ in stored))

    def _note_perhaps(self, facts: Facts) -> None:
        self.ready |= facts
        if self.effects is not None:
            self.effects.stored_or_stale += facts

    def is_fresh(self, name: str, stack: Sequence[Function]) -> bool:
        """
        Whether the run has stored ``name`` by now, but waits behind that on no way to here.

        Where a loop calls a function in each round, another call of it is as another run.
        """
        if self.effects is None or (Const(name), Word.STALE) in self.ready:
            return False
        storers = self.effects.storers.get(name, ())
        if not self.open_loops:
            return bool(storers)
        called = tuple(stack[: self.loop_depth + 1])
        is_inside = len(called) > self.loop_depth
        return (
            is_inside and bool(storers) and all(each[: len(called)] == called for each in storers)
        )

    @contextmanager
    def left_anywhere(self) -> Iterator[None]:
        """What is stored inside may have been stored, wherever that was left."""
        begun = self.stored_by_now()
        yield
        self.ready |= self.stored_since(begun)

    def stored_by_now(self) -> int:
        """How much was noted by now of what the run has stored."""
        return len(self.effects.stored_or_stale) if self.effects is not None else 0

    def stored_since(self, begun: int) -> Facts:
        """What may have been stored since, wherever the code there was left."""
        return frozenset(self.effects.stored_or_stale[begun:]) if self.effects else frozenset()

    def begin_outermost_loop(self) -> None:
        """A loop begins that stands in no other one."""

    def assume(self, implied: Implied | None, *, holds: bool) -> None:
        """From here on a test has come out so."""
        if implied is not None:
            self.ready |= (
                implied.holds | implied.knows if holds else implied.fails | implied.knows_not
            )

    def assume_picked(self, collection: Value, item: Value) -> None:
        """An item is taken out of a collection into which it was picked for what it answered."""
        picked = (
            self.picked.get(collection.serial, frozenset())
            if isinstance(collection, Heaped)
            else ()
        )
        options = options_of(item)
        self.ready |= {fact for fact in picked if fact[0] in options}

    def is_ready(self, value: Value | None, words: frozenset[Word]) -> bool:
        """Whether a wait for ``value`` that ``words`` end does not wait any more."""
        options = options_of(value) if value is not None else ()
        things = [option for option in options if not isinstance(option, Const)]
        known = {thing for thing, word in self.ready if word in words}
        return bool(things) and all(thing in known for thing in things)
