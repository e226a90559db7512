"""
What the interpreter reports while it follows a program.

In a bare interpreter each of these does nothing. Code that needs to know what runs beside
each other, waits for each other and shares data overrides them, see ``concurrency/notes.py``.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence, Set
from contextlib import AbstractContextManager, nullcontext

from ros2cc_extract.extract.static.python.machine.dependences import NOTHING_ASKED, Asked
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.path_facts import Implied
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.values.assumed_defaults import assumption
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Scope,
    Value,
)
from ros2cc_extract.source_locations import Place


class Observer:
    """Hooks, each called where the interpreter meets something, with the state of that moment."""

    def note_attribute(self, owner: Value, name: str, kind: AccessKind, place: Place) -> None:
        """An attribute is touched."""

    def note_replaced(self, owner: Value, name: str, old: Value) -> None:
        """An attribute gets another value than ``old``."""

    def note_held(self, owner: Value, name: str, value: Value) -> None:
        """An attribute has got a value."""

    def note_global(self, module: Module, name: str, kind: AccessKind, place: Place) -> None:
        """A global is touched."""

    def note_cell(self, scope: Scope, name: str, kind: AccessKind, place: Place) -> None:
        """A variable of a function is touched, perhaps by a function inside of it."""

    def note_update(self, target: ast.expr, frame: Frame, kind: AccessKind) -> None:
        """The object in a name or attribute gets a new content or value from its old one."""

    def note_part(self, target: ast.expr, frame: Frame, how: str = '') -> None:
        """An attribute or item of an object is stored, or a collection in it changes in place."""

    def note_iteration(self, node: ast.expr, frame: Frame, how: str | None = None) -> None:
        """
        A loop goes over a collection, which may not change in size meanwhile.

        :param how: it is done, see ``Access.iterates``, if not by asking for the next item.
        """

    def note_for(self, node: ast.For | ast.AsyncFor, frame: Frame) -> None:
        """A loop begins; what it goes over is known."""

    def note_discarded(self, value: Value, place: Place) -> None:
        """A statement does nothing with the value of the call that it consists of."""

    def note_call(self, function: Value, node: ast.Call, frame: Frame) -> None:
        """``function`` is called, with the arguments of ``node``."""

    def in_one_piece(
        self, node: ast.Assign | ast.AugAssign, frame: Frame
    ) -> AbstractContextManager[None]:
        """Inside, a statement stores what it has computed."""
        return nullcontext()

    def note_branch(
        self, node: ast.If, found: Set[str], place: Place, frame: Frame, *, is_first: bool
    ) -> None:
        """
        What the arms at ``place`` do rests on a test.

        :param found: names of the shared data that was read for it.
        :param is_first: it is that of the ``if`` itself and of no ``elif``.
        """

    def asked_by_loop(self, node: ast.While, names: frozenset[str], place: Place) -> Asked:
        """What the rounds of a loop rest on; ``names`` is the shared data read for its test."""
        return NOTHING_ASKED

    def note_return(self, node: ast.Return, frame: Frame, found: Set[str]) -> None:
        """A function is left; ``found`` is the shared data read for what it gives."""

    def note_left(self, frame: Frame, *, goes_on: bool) -> None:
        """A function has been followed; it may also end without a ``return`` if it ``goes_on``."""

    def note_raised(self, error: ast.expr, place: Place) -> None:
        """An exception is raised."""

    def held_behind_block(self, before: tuple[str, ...]) -> tuple[str, ...]:
        """The locks that are held behind a ``with``; ``before`` are those held in front of it."""
        return before

    def given_back_in(self, body: Sequence[ast.stmt]) -> tuple[str, ...]:
        """The locks that a handler of exceptions gives back: they are held where it begins."""
        return ()

    def note_entered(self, value: Instance, place: Place) -> None:
        """A ``with`` over an object of a library begins."""

    def note_left_block(self, value: Value, place: Place) -> None:
        """A ``with`` over ``value`` ends."""

    def note_lock_method(self, owner: Value, name: str) -> None:
        """A method of ``owner`` has run that is called like one of a lock."""

    def is_over(self, node: ast.While, frame: Frame) -> bool:
        """Whether the test of a ``while`` fails for certain, by what has run before."""
        return False

    def begin_loop(self, node: ast.While, frame: Frame, implied: Implied | None) -> object:
        """Begin a ``while`` whose test shows ``implied``; ``end_loop`` is given the result."""
        return None

    def begin_rounds(self, node: ast.While) -> object:
        """Begin a ``for`` over numbers, as the ``while`` that counts; as ``begin_loop``."""
        return None

    def end_loop(self, node: ast.While, frame: Frame, begun: object) -> None:
        """One round of a ``while`` has been followed that may come to another one."""

    def note_endless(self, node: ast.While, place: Place) -> None:
        """A loop was followed that nothing in its body leaves."""

    def note_results(self, value: Value, place: Place) -> None:
        """A loop goes over ``value``, which cannot be followed."""

    def note_await(self, value: Value, place: Place) -> None:
        """``value`` is awaited."""

    def note_suspended(self, place: Place) -> None:
        """A coroutine lets others run, at an ``async with`` or the like."""

    def note_turn(self, place: Place) -> None:
        """A coroutine lets others run and goes on by itself."""

    def note_unknown_call(self, function: Mystery, call: Call) -> None:
        """Something that could not be followed is called."""

    def note_library_call(self, name: str, place: Place) -> None:
        """A function of a library that no table has is called."""

    def give_away(self, value: Value, reason: str, place: Place) -> None:
        """Code that is not followed has ``value`` now."""


class LibraryHooks:
    """What the tables of libraries cannot say; a bare interpreter has nothing to add to them."""

    def other_member(
        self, cls: Library, receiver: Value | None, name: str, place: Place
    ) -> Value | None:
        """Attribute ``name`` of an object of a library class, where no table has it."""
        return None

    def member_of_unknown_base(
        self, order: tuple[Value, ...], receiver: Value, name: str, place: Place
    ) -> Value | None:
        """Attribute ``name`` where a base class is not known."""
        return None

    def member_of_mystery(self, value: Mystery, name: str, place: Place) -> Value | None:
        """Attribute ``name`` of a value; only its use shows what it is."""
        return None

    def library_operation(self, op: ast.operator, left: Value, right: Value) -> Value | None:
        """What an operator gives that a library defines."""
        return None

    def awaited(self, future: Instance, place: Place) -> Value | None:
        """What awaiting a future gives."""
        return None

    def takes_over(self, function: Native, arguments: list[Value], place: Place) -> bool:
        """Whether code that is given ``function`` is taken to run it with these arguments."""
        return False

    def assumption(self, fact: str, value: Mystery) -> str:
        """The rule by which ``fact`` is assumed to be the default of ``value``."""
        return assumption(fact, value)

    def objects_made(self) -> int:
        """The number of library objects whose identity matters."""
        return 0

    def doubt_objects(self, since: int, reason: str, place: Place) -> None:
        """Those that were made since there were so many may be older ones."""

    def doubt_calls(self, since: int, why: str, place: Place) -> None:
        """The same of what code that is not scanned may have kept from an earlier call."""
