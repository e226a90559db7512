"""What a machine offers to the tables of libraries that notes what runs concurrently."""

from __future__ import annotations

from abc import ABC, abstractmethod

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef, MessageRef
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.source_locations import Place, Unknown


class ConcurrentMachine(Machine, ABC):
    """Notes of waits, of what ends them, and of locks."""

    world: ConcurrentWorld

    @abstractmethod
    def future(self, place: Place, kind: str, of: Value | None = None) -> Instance:
        """A new future of ``kind``."""

    @abstractmethod
    def note_blocking(
        self, name: str, on: Value | None, seconds: Value | None, place: Place
    ) -> None:
        """A call that can hold its thread."""

    @abstractmethod
    def note_outside_wait(
        self,
        name: str,
        on: Value | None,
        seconds: Value | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        """Code that is no callback waits for ``on`` and spins some nodes meanwhile."""

    @abstractmethod
    def note_loop_on_data(
        self,
        name: str,
        on: DataRef | MessageRef | Unknown,
        seconds: Unknown | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        """A loop goes on until other code has written what its test reads."""

    @abstractmethod
    def note_messages(
        self, name: str, brings: Doer, place: Place, on: DataRef | None = None
    ) -> None:
        """
        Somebody waits for what the messages of a subscription bring.

        :param on: the data by which the wait ends as well.
        """

    @abstractmethod
    def note_acquire(self, lock: Value, place: Place, *, may_fail: bool = False) -> None:
        """A lock is taken; with a time-out it may not be."""

    @abstractmethod
    def note_release(self, lock: Value) -> None:
        """A lock is given back."""

    @abstractmethod
    def lock_name(self, lock: Instance, kind: str) -> str:
        """The name that a lock is stored under; a second one of that name gets a number."""

    @abstractmethod
    def note_wake(self, thing: Value, word: Word, place: Place, item: Value | None = None) -> None:
        """Something is done to ``thing`` that may end a wait for it."""

    @property
    @abstractmethod
    def runs_on_loop(self) -> bool:
        """Whether a loop of asyncio runs what is followed, as it runs callbacks."""

    @abstractmethod
    def task_of_loop(
        self, coroutine: Value, place: Place, loop: Value | None = None
    ) -> Value | None:
        """
        The task by which that loop runs ``coroutine``; ``None`` where there is no such loop.

        :param loop: the loop that it is handed over to; the giver may block until it is done.
        """

    @abstractmethod
    def add_task(self, future: Instance, callback: Value, place: Place) -> None:
        """Note that the code that takes the answer of ``future`` then runs ``callback``."""
