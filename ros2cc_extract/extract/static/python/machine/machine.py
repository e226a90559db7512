"""
What the parts of the interpreter and the library tables may ask of each other.

``interpreter.py`` puts the parts together; none of them imports another. What only a machine has
that notes what runs concurrently, or that models a library, stands in the rooms above.
"""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial

from ros2cc_extract.deadline import Deadline
from ros2cc_extract.extract.static.python.machine.frame import BudgetError, Frame
from ros2cc_extract.extract.static.python.machine.library_table import LibraryModel
from ros2cc_extract.extract.static.python.machine.observer import LibraryHooks, Observer
from ros2cc_extract.extract.static.python.machine.path_facts import of_all
from ros2cc_extract.extract.static.python.machine.store import Store, Writes
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Choice,
    Class,
    Function,
    FunctionNode,
    Instance,
    Library,
    Module,
    Mystery,
    Value,
    choice,
)
from ros2cc_extract.source_locations import Place, Unknown

THING_STEPS = 1_000
"""What an entity or a thread costs all that come later, in steps."""
PAIR_STEPS = 6
"""What an entity costs with each earlier one, as there are claims about both: some 300 of them."""

ENTRIES = 10
"""So many of an order of classes are gone through, or kept, in a step."""


class Machine(Observer, LibraryHooks, ABC):
    """The state every part shares, and what each part offers to the others."""

    store: Store
    world: World
    model: LibraryModel
    steps: int
    step_limit: int
    deadline: Deadline | None
    stack: list[Function]

    def last_wait(self) -> object:
        """The last wait that lies behind what is followed now."""
        return self.world.effects.behind if self.world.effects is not None else None

    def charge(self, steps: int) -> None:
        """
        Count so many steps of what is followed.

        :raises BudgetError: that was more than the running piece of a program may take.
        """
        self.steps += steps
        is_late = self.deadline is not None and self.deadline.is_over
        if self.steps > self.step_limit or is_late:
            raise BudgetError

    @abstractmethod
    def evaluate(self, node: ast.expr, frame: Frame) -> Value:
        """The value of an expression."""

    @abstractmethod
    def execute_block(self, body: Sequence[ast.stmt], frame: Frame) -> int:
        """Run statements; returns how the block may end, see ``block_exits.py``."""

    @abstractmethod
    def branches(self, bodies: Sequence[Callable[[], int]], place: Place, frame: Frame) -> int:
        """Run alternatives from one state; joins what may hold after them."""

    @abstractmethod
    def operate(
        self, op: ast.operator, left: Value, right: Value, frame: Frame, node: ast.AST
    ) -> Value:
        """``left op right``."""

    @abstractmethod
    def assign(self, target: ast.expr, value: Value, frame: Frame) -> None:
        """Store ``value`` in a name, attribute, item or pattern of them."""

    @abstractmethod
    def set_attribute(self, owner: Value, name: str, value: Value, place: Place) -> None:
        """``object.__setattr__(owner, name, value)``."""

    @abstractmethod
    def store_field(self, owner: Value, name: str, value: Value, place: Place) -> None:
        """``owner.__dict__[name] = value``."""

    @abstractmethod
    def attribute(self, value: Value, name: str, place: Place, text: str | ast.expr = '') -> Value:
        """``value.name``."""

    @abstractmethod
    def attribute_as_of_now(self, owner: Instance, name: str, held: Value, place: Place) -> Value:
        """What an attribute holds once the set-up is over."""

    @abstractmethod
    def has_attribute(self, value: Value, name: str) -> bool | None:
        """Whether ``value.name`` exists; ``None`` when that depends."""

    @abstractmethod
    def call(self, function: Value, call: Call) -> Value:
        """The result of a call, after its effects."""

    @abstractmethod
    def make_class(self, node: ast.ClassDef, frame: Frame) -> Class:
        """A class from its statement, its body run."""

    @abstractmethod
    def import_module(self, name: str, place: Place) -> Value:
        """A scanned module, or a library of that name."""

    @abstractmethod
    def special_method(self, owner: Value, name: str, place: Place) -> Bound | None:
        """A method of a scanned class that Python calls for a statement or built-in function."""

    @abstractmethod
    def library(self, name: str) -> Value:
        """What a dotted name of a library stands for."""

    @abstractmethod
    def items_of(self, value: Value, place: Place) -> tuple[tuple[Value, ...], Unknown | None]:
        """What iterating over ``value`` gives, and why there may be more."""

    @abstractmethod
    def truth(self, value: Value) -> bool | None:
        """``bool(value)``; ``None`` when that depends."""

    @abstractmethod
    def comprehend(self, node: ast.expr, frame: Frame) -> Value:
        """The value of a comprehension or generator expression."""

    @abstractmethod
    def make_function(self, node: FunctionNode, frame: Frame) -> Value:
        """A function from its definition, its decorators applied."""

    @abstractmethod
    def imported(self, module: Value, module_name: str, name: str, place: Place) -> Value:
        """What ``from module import name`` gives."""

    @abstractmethod
    def enter_context(self, value: Value, place: Place, *, is_async: bool = False) -> Value:
        """What ``with value as x`` binds to ``x``, or ``async with``."""

    @abstractmethod
    def changed_globals(self, module: Module) -> frozenset[str]:
        """Names of globals that some function of the module rebinds or changes in place."""

    @abstractmethod
    def run_function(self, function: Function, call: Call) -> Value:
        """Run the body of a scanned function, also of a coroutine function."""

    @abstractmethod
    def running_classes(self) -> frozenset[Class]:
        """The classes whose methods are running."""

    @abstractmethod
    def prepare(self, instance: Instance) -> None:
        """Give a new instance the state that its library bases add."""

    @abstractmethod
    def call_library(self, function: Library, call: Call) -> Value:
        """Call a name of a library: make an instance, or give a mystery."""

    @abstractmethod
    def library_call(self, function: Value, call: Call) -> None:
        """Something unknown is called, perhaps with a node among its arguments."""

    @abstractmethod
    def note_handed(
        self, values: Iterable[Value], place: Place, name: str, by: Value | None = None
    ) -> None:
        """Functions that code which is not scanned has now, that of ``by`` if it is known."""

    @abstractmethod
    def library_member(
        self, cls: Library, receiver: Value | None, name: str, place: Place
    ) -> Value | None:
        """Attribute ``name`` that a library class gives to ``receiver``."""

    @abstractmethod
    def submodule(self, module: Module, name: str, place: Place) -> Value | None:
        """A module of a scanned package."""

    @abstractmethod
    def await_value(self, value: Value, place: Place) -> Value:
        """``await value``."""

    @abstractmethod
    def run_if_coroutine(self, value: Value, place: Place) -> Value:
        """Run ``value`` if it is a coroutine, which is awaited elsewhere."""

    @abstractmethod
    def zero_argument_super(self, frame: Frame) -> Value:
        """``super()`` in the method that is running."""

    @abstractmethod
    def instantiate(self, cls: Class, call: Call) -> Value:
        """Make an instance of a scanned class and run its ``__init__``."""

    @abstractmethod
    def allocate(self, cls: Class, call: Call) -> Instance:
        """A new object of ``cls``, as ``object.__new__`` makes it."""

    @abstractmethod
    def name_value(self, value: Value, name: str) -> None:
        """Remember the first name under which a group, an executor … is stored."""

    def stop_program(self) -> None:
        """The program ends here on this branch (``sys.exit``)."""
        self.world.stopped = True

    def why_many(self) -> Value:
        """Why what is collected here stands for any number of items; ``NONE`` when for one."""
        count = self.world.count
        return Mystery(count) if isinstance(count, Unknown) else NONE

    def mystery(self, reason: str, place: Place | None, text: str | ast.expr = '') -> Mystery:
        """A value that cannot be followed."""
        return Mystery(Unknown(reason, place), text)

    def branch(self, choices: Sequence[Callable[[], Value]], place: Place) -> Value:
        """
        Try each of ``choices`` from the same state and join what they leave behind.

        A choice that ends the program leaves nothing behind, unless all do.
        """
        results: list[tuple[Value, Writes, bool]] = []
        ready, ends = self.world.ready, []
        held, kept_locks = self.world.held, []
        for index, attempt in enumerate(choices):
            self.world.held, self.world.ready = held, ready
            with self.on_path(place, index):
                mark = self.store.open_branch()
                result = attempt()
                stopped, self.world.stopped = self.world.stopped, False
                results.append((result, self.store.close_branch(mark), stopped))
                if not stopped:
                    ends.append(self.world.ready)
                    kept_locks.append(self.world.held)
        self.world.ready = of_all(ends or [ready])
        self.world.held = held_by_all(kept_locks or [held])
        going_on = [entry for entry in results if not entry[2]]
        self.world.stopped = not going_on
        kept = going_on or results
        self.store.join([writes for _, writes, _ in kept])
        return choice([result for result, _, _ in kept])

    @contextmanager
    def on_path(self, place: Place, index: int) -> Iterator[None]:
        """Everything done inside depends on the branch ``index`` at ``place``."""
        before = self.world.path
        self.world.path = (*before, (place, index))
        try:
            yield
        finally:
            self.world.path = before

    def each(self, value: Value, act: Callable[[Value], Value], place: Place) -> Value:
        """Do ``act`` on every option of ``value``, as alternatives if there are several."""
        if not isinstance(value, Choice):
            return act(value)
        options = value.options
        return self.branch([partial(act, option) for option in options], place)


def held_by_all(ends: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """Locks that are held however the branches were left."""
    return tuple(lock for lock in ends[0] if all(lock in others for others in ends[1:]))
