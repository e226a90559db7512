"""
What the interpreter reports, handed to the code it concerns: the entry to concurrency.

The interpreter calls these hooks, see ``observer.py``; each module behind them knows one matter.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence, Set
from contextlib import AbstractContextManager, contextmanager

from ros2cc_extract.extract.static.concurrency.accesses import (
    atomic_updates,
    iterations,
    kept_threads,
    lost_notifications,
    torn_state,
    torn_updates,
    unreleased_locks,
    web_servers,
)
from ros2cc_extract.extract.static.concurrency.accesses.flags import (
    claims,
    flag_locks,
    tested_copies,
)
from ros2cc_extract.extract.static.concurrency.accesses.unreleased_locks import locks_given_back
from ros2cc_extract.extract.static.concurrency.effects import Effects
from ros2cc_extract.extract.static.concurrency.waits import loop_tasks
from ros2cc_extract.extract.static.concurrency.waits.loops import (
    counted_tests,
    polling_loops,
    set_up_loops,
    timed_loops,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import exit_tests
from ros2cc_extract.extract.static.concurrency.waits.rounds import forget_rounds
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import goes_round
from ros2cc_extract.extract.static.program.generator_texts import yields_each_round
from ros2cc_extract.extract.static.program.text_queries import is_recursion
from ros2cc_extract.extract.static.python.machine.dependences import Asked
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.path_facts import Implied
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.objects.escape import reached
from ros2cc_extract.extract.static.python.values.containers import Generator
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Coroutine,
    Instance,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import BY_INDEX, COPIED


class Notes(Effects):
    """Beside accesses, locks and waits: tests, loops, and the ways out of functions."""

    def note_acquire(self, lock: Value, place: Place, *, may_fail: bool = False) -> None:
        """A task of a loop may take it while another one keeps it."""
        super().note_acquire(lock, place, may_fail=may_fail)
        if not may_fail:
            loop_tasks.note_taken(self.world, lock, place)

    def note_await(self, value: Value, place: Place) -> None:
        """A task of a loop waits; its own coroutines are only calls."""
        loop_tasks.note_awaited(self.world, value)
        if not isinstance(value, Coroutine):
            self.note_suspended(place)
        super().note_await(value, place)

    def note_suspended(self, place: Place) -> None:
        """A task of a loop lets others run."""
        loop_tasks.note_suspended(self.world, place)

    def note_library_call(self, name: str, place: Place) -> None:
        """A web server may be run."""
        web_servers.note_run(self.world, name, '', place)

    def note_unknown_call(self, function: Mystery, call: Call) -> None:
        """A web server may be run; or it waits by its name."""
        web_servers.note_run(self.world, function.text, function.unknown.reason, call.place)
        super().note_unknown_call(function, call)

    def note_part(self, target: ast.expr, frame: Frame, how: str = '') -> None:
        """An attribute or item of an object is stored, or a collection in it changes in place."""
        torn_updates.note_changed(self, target, frame, how)

    def note_call(self, function: Value, node: ast.Call, frame: Frame) -> None:
        """A call may publish an object as a whole, or take all items of a collection."""
        torn_updates.note_sent(self, function, node, frame)
        rows = iterations.taken_at_once(function, node)
        if rows is not None:
            self.note_iteration(rows, frame, COPIED)
        self._note_step(iterations.stepped(function, node), frame)

    def _note_step(self, generator: ast.expr | None, frame: Frame) -> None:
        """A generator goes on from where it was: it cannot be entered by two at once."""
        if self.world.effects is None or not isinstance(generator, (ast.Attribute, ast.Name)):
            return
        noted, self.world.effects = self.world.effects, None
        values = options_of(self.evaluate(generator, frame))
        self.world.effects = noted
        if any(isinstance(value, Generator) for value in values):
            self.note_update(generator, frame, AccessKind.UPDATE)

    def note_for(self, node: ast.For | ast.AsyncFor, frame: Frame) -> None:
        """It goes over a collection, itself or by its indices."""
        if isinstance(node, ast.AsyncFor):
            self.note_suspended(frame.place(node.iter))
        self.note_iteration(node.iter, frame)
        self._note_step(node.iter, frame)
        rows = iterations.by_index(node) if isinstance(node, ast.For) else None
        if rows is not None:
            self.note_iteration(rows, frame, BY_INDEX)

    def in_one_piece(
        self, node: ast.Assign | ast.AugAssign, frame: Frame
    ) -> AbstractContextManager[None]:
        """While the statement is followed, its write is known to be in one piece, if it is."""
        counted_tests.note_step(self, node, frame)
        return self._storing(node, frame)

    @contextmanager
    def _storing(self, node: ast.Assign | ast.AugAssign, frame: Frame) -> Iterator[None]:
        taken = torn_state.noted(self.world.reading, node, frame)
        with taken, atomic_updates.noted(self, node, frame):
            self.world.reading.is_claim = claims.is_claim(node, frame)
            try:
                yield
            finally:
                self.world.reading.is_claim = False

    def note_branch(
        self, node: ast.If, found: Set[str], place: Place, frame: Frame, *, is_first: bool
    ) -> None:
        """A test may find a flag down, or ask for what other code notifies of."""
        reading = self.world.reading
        if is_first:
            flag_locks.note_test(
                reading,
                node,
                flag_locks.behind_getters(self, node.test, frame),
                found,
                place,
                lambda each: flag_locks.constant_text(self, each, frame),
            )
            tested_copies.note_test(self, node, place, frame)
            reading.around[place] = self.world.laps
            kept_threads.note_test(self, node, place, frame)
        lost_notifications.note_test(self.world, node.test, place, reading.tests[place])

    def asked_by_loop(self, node: ast.While, names: frozenset[str], place: Place) -> Asked:
        """A loop may ask for what other code notifies of."""
        return lost_notifications.note_test(self.world, node.test, place, names, repeats=True)

    def note_return(self, node: ast.Return, frame: Frame, found: Set[str]) -> None:
        """A way out of a function: flags are held there, or a goal is turned down."""
        flag_locks.note_return(self.world, frame, node, found)

    def note_raised(self, error: ast.expr, place: Place) -> None:
        """A way out of a function, where a caller catches it."""
        unreleased_locks.note_raised(self.world, error, place)

    def note_left(self, frame: Frame, *, goes_on: bool) -> None:
        """A flag that is held on some ways out only is not held for certain."""
        flag_locks.leave(self.world, frame, goes_on=goes_on)

    def held_behind_block(self, before: tuple[str, ...]) -> tuple[str, ...]:
        """The locks of a ``with`` are given back, and flags stay as they are."""
        return flag_locks.after_block(before, self.world.held)

    def given_back_in(self, body: Sequence[ast.stmt]) -> tuple[str, ...]:
        """A handler that gives locks back runs while they are held."""
        return locks_given_back(body, self.world)

    def begin_loop(self, node: ast.While, frame: Frame, implied: Implied | None) -> object:
        """A loop may do nothing but wait."""
        if not goes_round(node) or self._is_driven(node):
            return None
        length = timed_loops.length_of(self, node, frame)
        before = polling_loops.mark(self, length)
        polling_loops.begin(self, node, frame, implied)
        return before

    def _is_driven(self, node: ast.While) -> bool:
        """Whether each round gives an item to code that takes one at a time: it goes on then."""
        return self.world.one_by_one and yields_each_round(node.body)

    def begin_rounds(self, node: ast.While) -> object:
        """It may look for data of others in each round, and end by its number of rounds."""
        return polling_loops.mark(self) if goes_round(node) else None

    def end_loop(self, node: ast.While, frame: Frame, begun: object) -> None:
        """After one round it shows what the loop waits for."""
        if not goes_round(node) or self._is_driven(node):
            return
        if begun is None:
            set_up_loops.note(self, node, frame)
            return
        assert isinstance(begun, polling_loops.Mark)
        polling_loops.note(self, node, frame, begun)
        if self.world.effects is not None:
            tests = {frame.place(part) for part in (node, *exit_tests(node))}
            forget_rounds(self.world.effects, begun.waits, tests)
        if begun.length is not None:
            timed_loops.note(self, node, frame, begun.length, begun.waits, begun.met)
        if is_recursion(node):
            polling_loops.mark_recursive(self, node, frame, begun)

    def note_results(self, value: Value, place: Place) -> None:
        """Note a wait: a loop over what ``Executor.map`` returns waits for it."""
        if isinstance(value, Instance) and value.hint == 'map' and value.state is not None:
            self.note_blocking('Executor.map', value, None, place)

    def give_away(self, value: Value, reason: str, place: Place) -> None:
        """
        Note that code that is not followed has an event, a queue …, or a method of one.

        It may end waits then, and so it may with what is inside of a list, a tuple or an object.
        """
        for thing in reached(value):
            known = self.world.given.get(id(thing))
            # What a queue does with it may be seen in the end; what others do is not seen.
            if known is None or (known.reason != reason and 'queue' in known.reason):
                self.world.given[id(thing)] = Unknown(reason, place)
