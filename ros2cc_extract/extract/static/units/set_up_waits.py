"""
Waits of code that no callback runs: ``main``, constructors, functions without a known caller.

They hold up only the code itself, so they are in no model. What ends each is found as for
the waits of callbacks; where that is a callback, its node must be spun meanwhile.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import zip_longest

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, SetUpWait
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import EntityRef
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import in_words
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.executor import Unit
from ros2cc_extract.extract.static.units.late_servers import late_servers
from ros2cc_extract.extract.static.units.unserved_threads import UnservedThreads, UnservedWait
from ros2cc_extract.extract.static.units.waits import UnitWaits
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import spun_beside
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, TIME, UNCALLED, Blocking, Needs

_UNSPUN = 'no known code spins {node} meanwhile'
_NOBODY = 'no known code ends it'
_IN_HANDLER = 'a handler of a signal keeps the main thread'
_STAYS = 'the thread may loop forever'


def share_out(world: RosWorld, units: Sequence[Unit]) -> None:
    """Give each wait to the unit whose nodes it has to do with; the rest to the first."""
    homes = {id(node): unit for unit in units for node in unit.nodes}
    for wait in world.set_up.values():
        if wait.by is not None and not wait.by.is_executor:
            _note_never_there(wait, world)
            continue  # it is reported as a wait of that thread
        touched = (homes.get(id(node)) for node in _nodes_of(wait, world))
        home = next((unit for unit in touched if unit is not None), units[0] if units else None)
        if home is not None:
            home.set_up.append(wait)


def _note_never_there(wait: SetUpWait, world: RosWorld) -> None:
    """Tell of what ``main`` makes only when it has waited for it, beside a thread that spins."""
    late = late_servers(wait, world)
    if late is not None and late.is_sure:
        world.diagnostics.append(late.diagnostic())


def _nodes_of(wait: SetUpWait, world: RosWorld) -> Iterator[object]:
    thing = wait.outside.client
    state = thing.state if isinstance(thing, Instance) else None
    of = state.of if isinstance(state, PlainState) and state.of is not None else thing
    if isinstance(of, Instance) and isinstance(of.state, EntityState):
        yield of.state.node
    on = wait.block.on
    if isinstance(on, EntityRef):
        yield from (entity.node for entity in world.entities if id(entity) == on.number)
    if isinstance(of, Instance) and isinstance(of.state, NodeState):
        yield of
    yield from wait.outside.spun
    for waking in world.wakings.get(id(thing), ()):
        if isinstance(waking.by, EntityState):
            yield waking.by.node


def named_waits(
    waits: Iterable[SetUpWait], world: RosWorld, named: UnitWaits, doers: Mapping[str, object]
) -> tuple[Blocking, ...]:
    """
    The waits by the names of their unit, with what ends them.

    :param doers: the callbacks and activities of the unit.
    """
    by_block = {id(wait.block): wait for wait in waits}
    found = named.of_set_up([wait.block for wait in by_block.values()])
    findings = {each.place for each in world.diagnostics if each.slug == 'nobody-spins'}
    return tuple(
        dict.fromkeys(
            block
            if block.source in findings
            else _SetUpWaits(world, named, doers).decided(block, by_block[id(raw)])
            for raw, block in found
        )
    )


@dataclass(frozen=True)
class _SetUpWaits:
    world: RosWorld
    named: UnitWaits
    doers: Mapping[str, object]

    def decided(self, block: Blocking, wait: SetUpWait) -> Blocking:
        """The wait with the reason why it is unknown whether it ends, if so."""
        late = late_servers(wait, self.world)
        if late is not None and late.is_sure:
            self.world.diagnostics.append(late.diagnostic())
            return block
        if late is not None:
            return replace(block, escapes=Unknown(late.why_open, block.source))
        is_open = block.seconds is None and block.escapes is None
        is_open = is_open and not block.initial  # of a semaphore: it is free
        if not is_open or any(waker.by in (OUTSIDE, TIME) for waker in block.wakers):
            return block
        why = self._why_open(block, wait)
        return block if why is None else replace(block, escapes=Unknown(why, block.source))

    def _why_open(self, block: Blocking, wait: SetUpWait) -> str | None:
        outside = wait.outside
        served = {id(node) for node in (*outside.spun, *spun_beside(outside, self.world))}
        threads = UnservedThreads(self.named, self.doers, frozenset(served))
        # Where something has been spun before, a thread may have its answers.
        is_first = wait.in_handler or (outside.begun == 0 and not wait.is_late)
        unserved = [threads.before(waker) for waker in block.wakers] if is_first else []
        reasons = [
            _why_not(self.doers.get(waker.by), wait, served) if stuck is None else _why(stuck)
            for waker, stuck in zip_longest(block.wakers, unserved)
        ]
        open_ones = [reason for reason in reasons if reason is not None]
        is_met = len(open_ones) < len(reasons) if block.needs is not Needs.ALL else not open_ones
        if reasons and is_met:
            return None
        if wait.uncalled:
            return f'{UNCALLED}{wait.uncalled}'
        stuck_ones = [each for each in unserved if each is not None]
        if stuck_ones and self._is_sure(stuck_ones, len(reasons), block, wait):
            self.world.diagnostics.append(_never(block, stuck_ones[0]))
            return None
        why = open_ones[0] if open_ones else _NOBODY
        return f'{_IN_HANDLER}, and {why}' if wait.in_handler else why

    def _is_sure(
        self, unserved: Sequence[UnservedWait], wakers: int, block: Blocking, wait: SetUpWait
    ) -> bool:
        """Whether it never ends, even if there is more that was not seen."""
        is_needed = len(unserved) == wakers or block.needs is Needs.ALL
        is_needed = is_needed and not any(each.may_skip for each in unserved)
        is_needed = is_needed and not wait.in_handler
        nodes = (node.state for node in self.world.nodes)
        in_sight = (isinstance(s, NodeState) and s.ghost is None and not s.more for s in nodes)
        return is_needed and not wait.outside.path and all(in_sight)


def _why(stuck: UnservedWait) -> str:
    node = stuck.node.hint or stuck.node.class_name
    return (
        f'thread {stuck.thread} itself waits in {in_words(stuck.block.call)}, and '
        + _UNSPUN.format(node=node)
    )


def _never(block: Blocking, stuck: UnservedWait) -> Diagnostic:
    at = f' ({stuck.block.source})' if stuck.block.source is not None else ''
    awaited = f' for {stuck.block.resource}' if stuck.block.resource else ''
    return Diagnostic(
        severity=Severity.ERROR,
        slug='nobody-spins',
        place=block.source or Place(''),
        message=f'{block.call} waits for thread {stuck.thread}, which itself waits in '
        f'{in_words(stuck.block.call)}{awaited}{at}, and nothing spins the node whose callback '
        'would end that meanwhile: it waits forever',
        help='wait for the thread after the spin, or let another thread spin the node before',
    )


def _why_not(doer: object, wait: SetUpWait, served: set[int]) -> str | None:
    """Why it is not known whether ``doer`` does what ends the wait; ``None`` where it does."""
    if isinstance(doer, ActivityState):
        return _STAYS if wait.is_late and doer.endless is not None else None
    if not isinstance(doer, EntityState) or id(doer.node) in served:
        return None
    return _UNSPUN.format(node=doer.node.hint or doer.node.class_name)
