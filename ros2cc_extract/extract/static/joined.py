"""
Threads that the set-up joins while nobody serves whoever would end what they wait for.

At the end of many programs a flag is cleared and the thread is joined that asks for it; but the
thread stands in a wait that only callbacks end, and the spin that served them is over.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.doing import ActivityState
from ros2cc_extract.extract.static.uncalled import uncalled_wakers
from ros2cc_extract.extract.static.values import Instance, Value
from ros2cc_extract.extract.static.wakings import ResourceRef
from ros2cc_extract.extract.static.world import EntityState, OutsideWait, World
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import WORKING_LOOP, Blocking

JOIN = 'Thread.join'


def note_join(world: World, thread: Value, place: Place) -> None:
    """The set-up, or what comes after its spin, waits for the end of ``thread``."""
    if isinstance(thread, Instance) and world.is_program and world.deeds is None:
        is_late = world.after_spin or bool(world.spins)
        world.outside.append(OutsideWait(JOIN, thread, place, world.in_thread, (), is_late))


def never_joined(
    wait: OutsideWait, world: World, spun: Sequence[Instance]
) -> Iterator[Diagnostic]:
    """
    The waits of a joined thread that only callbacks end which nobody serves.

    :param spun: the nodes that other threads spin meanwhile.
    """
    for state in world.activities:
        if not any(wait.client is runner for runner in state.runners) or state.serves:
            continue
        goes_round = state.loops or any(b.call == WORKING_LOOP for b in state.deeds.blocking)
        for block in state.deeds.blocking:
            if goes_round or not wait.is_late:
                nodes = _servers(block, world)
                if nodes and not any(node is each for node in nodes for each in spun):
                    yield _told(wait, state, block)
                    return


def _servers(block: Blocking, world: World) -> list[Instance]:
    """The nodes whose callbacks end the wait; none where somebody else may end it."""
    resource = block.resource
    if block.seconds is not None or not isinstance(resource, ResourceRef) or resource.asked:
        return []
    mine = [w for w in world.wakings.get(resource.number, ()) if w.word in resource.ended_by]
    doers = [waking.by for waking in mine]
    nodes = [doer.node for doer in doers if isinstance(doer, EntityState)]
    is_open = resource.number in world.given or uncalled_wakers(
        world, str(resource), resource.ended_by, resource.made
    )
    return [] if is_open or len(nodes) < len(doers) else nodes


def _told(wait: OutsideWait, state: ActivityState, block: Blocking) -> Diagnostic:
    at = f' ({block.source})' if block.source is not None else ''
    when = 'any more' if wait.is_late else 'meanwhile'
    may = 'it may wait' if wait.is_late else 'it waits'
    return Diagnostic(
        severity=Severity.WARNING if wait.is_late else Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{JOIN} waits for a thread that waits in {block.call} for {block.resource}{at}, '
        f'and nobody spins the node whose callback would end that {when}: {may} for ever',
        help='wake the thread before you join it: by a last item, by a notify after its flag has '
        'changed; or give its wait a time-out'
        if wait.is_late
        else 'join it after the spin, and wake it before',
    )
