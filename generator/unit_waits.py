"""The steps of callbacks and activities as the templates see them."""

from __future__ import annotations

from ros2cc_extract.generator.nested_spins import NestedSpin
from ros2cc_extract.generator.program_steps import WaitKind
from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class UnitWait:
    """
    A step of a callback in the model: a wait, or a signal that ends waits of others.

    :param place: of the callback that it is for; of its own where it is for none.
    :param frees_thread: an ``await``.
    :param is_for_callback: the callback at ``place`` ends it.
    :param node: place of the node that a nested spin gives to the global executor.
    :param lock: place of the lock that is waited for; ``None`` for none.
    :param held: places of the locks that are held meanwhile.
    :param resource: place of what is waited for, or gets a signal.
    :param begun: places of the starts without which what is waited for is not there.
    :param is_signal: it is no wait.
    :param past: of a signal, the step to which a branch leads that skips it, if not the next one.
    :param wakers: names of those that give signals to the resource.
    """

    place: int
    kind: WaitKind
    frees_thread: bool
    is_for_callback: bool
    spin: NestedSpin | None = None
    node: int = 0
    lock: int | None = None
    held: frozenset[int] = frozenset()
    resource: int | None = None
    begun: frozenset[int] = frozenset()
    is_signal: bool = False
    may_skip: bool = False
    past: int | None = None
    is_open: bool = False
    wakers: tuple[str, ...] = ()

    @property
    def needs_signal(self) -> bool:
        """A wait for a signal."""
        return self.resource is not None and not self.is_signal

    @property
    def is_absent(self) -> bool:
        """For a service that may never be offered."""
        return self.kind is WaitKind.ABSENT

    @property
    def is_foreign(self) -> bool:
        """For a future that a thread of the user's own makes done."""
        return self.kind is WaitKind.FOREIGN

    @property
    def spun(self) -> int:
        """Number of the executor that is spun, 0 for none."""
        return self.spin.spun.value if self.spin else 0

    @property
    def end(self) -> int:
        """Number of what ends a nested spin."""
        return self.spin.end.value if self.spin else 0

    @property
    def is_timed(self) -> bool:
        """A nested spin that also ends by itself."""
        return self.spin is not None and self.spin.is_timed

    @property
    def refusal(self) -> int:
        """Whether the executor refuses to be spun, by number."""
        return self.spin.refusal.value if self.spin else 0


@dataclass(frozen=True, kw_only=True)
class UnitResource:
    """
    What callbacks wait for and give signals to.

    :param most: how many signals are kept; more would end no more waits.
    :param forgets: they are kept only for those that wait already.
    :param least: so many must be there before a wait ends.
    """

    name: str
    is_each: bool
    initial: int
    most: int
    forgets: bool = False
    least: int = 1

    @property
    def counts(self) -> bool:
        """True when a wait needs a signal of its own, or several."""
        return self.is_each or self.least > 1


@dataclass(frozen=True, order=True)
class SpinForm:
    """
    How nested spins are described.

    :param spun: number of the executor.
    """

    spun: int
    is_for_callback: bool
