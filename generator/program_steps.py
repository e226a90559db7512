"""
The steps of a callback's program as models have them: waits, takings of locks, signals.

They are taken in their order; a callback may end before any wait, and gives its signals then.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import field
from enum import Enum

from ros2cc_extract.generator.nested_spins import NestedSpin, SpinEnd
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import Blocking, Waker


class WaitKind(Enum):
    """What a callback keeps while it waits, and what ends the wait."""

    HELD = 'the thread is held until another callback has run'
    AWAITED = 'the thread is freed, the group is held'
    FOREIGN = 'as awaited, for what a thread of the user makes done'
    ABSENT = 'the thread is held until somebody outside offers a service'
    SPUN = 'the thread spins an executor'
    LOCKED = 'the thread is held until another callback gives back a lock'
    SIGNAL = 'no wait: it ends waits of others'


@dataclass(frozen=True)
class Lock:
    """
    A lock, by its name.

    A specification gives two locks two names, and nodes may share one.
    """

    name: str


@dataclass(frozen=True)
class Resource:
    """
    What waits are for and signals are given to.

    :param is_each: a signal ends one wait; else the first ends all, for good.
    :param initial: how many waits end without a signal.
    :param least: of what ends for good, how many signals that takes.
    :param forgets: a signal is lost while nothing waits.
    :param given_by: of what ends for good, what ends it, and where: what ends one wait for it may
        come too early for another.
    """

    name: str
    is_each: bool
    initial: int = 0
    forgets: bool = False
    least: int = 1
    given_by: frozenset[Waker] = frozenset()


@dataclass(frozen=True)
class NamedWait:
    """
    One step of a callback: a wait, or a signal that ends waits of others.

    :param needed: name of the callback of the unit that must run before it ends; its own where
        none must.
    :param lock: what it waits for, to keep it over the next wait if that holds it.
    :param held: locks that are held meanwhile, outermost first.
    :param resource: that it waits for, or gives a signal to.
    :param begun: starts; one of them must have been given: what is waited for is not there before.
    :param may_skip: a branch may skip it; of a signal, then it is unknown whether it comes.
    :param past: of a signal, the step after those that come only behind it; ``None`` for the next.
    :param is_open: something that the model does not have may end it, or nothing does.
    :param origin: place in the specification, with ``block`` or ``waker``.
    """

    needed: str
    kind: WaitKind
    spin: NestedSpin | None = None
    lock: Lock | None = None
    held: tuple[Lock, ...] = ()
    resource: Resource | None = None
    begun: tuple[Resource, ...] = ()
    may_skip: bool = False
    past: int | None = None
    is_open: bool = False
    origin: int = field(default=0, compare=False)
    block: Blocking | None = field(default=None, compare=False)
    waker: Waker | None = field(default=None, compare=False)
    wakers: tuple[str, ...] = field(default=(), compare=False)

    @property
    def is_signal(self) -> bool:
        """No wait."""
        return self.kind is WaitKind.SIGNAL

    @property
    def frees_thread(self) -> bool:
        """An ``await``, which holds the group alone."""
        return self.kind in (WaitKind.AWAITED, WaitKind.FOREIGN)

    @property
    def is_for_callback(self) -> bool:
        """True when another callback of the unit ends it."""
        if self.spin is not None:
            return self.spin.end is SpinEnd.ANSWER
        if self.resource is not None:
            return False
        return self.kind in (WaitKind.HELD, WaitKind.AWAITED)


def gives(steps: Iterable[NamedWait], resource: Resource) -> bool:
    """Return whether one of some steps gives a resource a signal."""
    return any(step.is_signal and step.resource == resource for step in steps)
