"""
Threads that the set-up waits for, and that themselves wait for callbacks that are not served yet.

The executor is spun behind the set-up: a thread that a constructor starts and joins gets no
answer of a client meanwhile.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.waits import UnitWaits
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import Blocking, Needs, Waker


@dataclass(frozen=True)
class UnservedWait:
    """
    A wait of a thread that only callbacks end.

    :param thread: its name.
    :param node: of one of these callbacks, which nothing spins.
    :param may_skip: a branch may lead past it.
    """

    thread: str
    block: Blocking
    node: Instance
    may_skip: bool


class UnservedThreads:
    """
    Which threads stand in such a wait while the set-up waits.

    :param doers: the callbacks and activities of the unit by their names.
    :param served: identities of the nodes that are spun meanwhile.
    """

    def __init__(
        self, named: UnitWaits, doers: Mapping[str, object], served: frozenset[int]
    ) -> None:
        self._named = named
        self._doers = doers
        self._served = served
        self._asked: set[str] = set()

    def before(self, waker: Waker) -> UnservedWait | None:
        """Give the first such wait that a thread has before it does what ``waker`` says."""
        doer = self._doers.get(waker.by)
        if not isinstance(doer, ActivityState) or waker.by in self._asked:
            return None
        self._asked.add(waker.by)  # one that waits for itself is reported elsewhere
        found = self._first(waker.by, self._named.of(doer)[: waker.after])
        self._asked.discard(waker.by)
        return found

    def _first(self, thread: str, blocks: Iterable[Blocking]) -> UnservedWait | None:
        """The first that no branch leads past, or else the first of all."""
        maybe: UnservedWait | None = None
        for block in blocks:
            if block.seconds is None and block.escapes is None and not block.initial:
                found = self._unserved(thread, block)
                if found is not None and not found.may_skip:
                    return found
                maybe = maybe or found
        return maybe

    def _unserved(self, thread: str, block: Blocking) -> UnservedWait | None:
        lacks = [each for each in map(self._missing, block.wakers) if each is not None]
        if not lacks or (block.needs is not Needs.ALL and len(lacks) < len(block.wakers)):
            return None
        may_skip = block.conditional or any(behind.may_skip for _, behind in lacks if behind)
        return UnservedWait(thread, block, lacks[0][0], may_skip)

    def _missing(self, waker: Waker) -> tuple[Instance, UnservedWait | None] | None:
        """
        The node without which ``waker`` does nothing; ``None`` where it may do it.

        With the wait of the thread that does it, where that is one.
        """
        doer = self._doers.get(waker.by)
        if isinstance(doer, EntityState):
            return None if id(doer.node) in self._served else (doer.node, None)
        behind = self.before(waker)
        return None if behind is None else (behind.node, behind)
