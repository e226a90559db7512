"""
Waits of code that is no callback, and whether the node is spun meanwhile.

Source: rclpy 7.1.6, ``client.py`` (``call`` waits for an event), ``__init__.py``
(``spin_until_future_complete`` spins the given node alone), ``task.py`` (``__await__``),
``timer.py`` (``Rate.sleep`` waits for an event that a timer of the node sets).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import OutsideWait
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import Waking
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import JOIN, RATE, in_words
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
    uncalled_wakers,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const, Instance, Value, options_of
from ros2cc_extract.extract.static.units.whole_program.joined_threads import is_over, never_joined
from ros2cc_extract.extract.static.units.whole_program.threads_at_exit import kept_at_exit
from ros2cc_extract.extract.static.units.whole_program.threads_until_shutdown import (
    joined_while_ok,
)
from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS


def note_unanswered(world: RosWorld) -> None:
    """Report, after all was followed, waits whose answer cannot be taken or given."""
    if any(_may_be_spun_elsewhere(node) for node in world.nodes):
        return
    reported = [each for wait in world.outside for each in _diagnostics(wait, world)]
    worst = {each.place for each in reported if each.severity is Severity.ERROR}
    world.diagnostics.extend(
        each for each in reported if each.severity is Severity.ERROR or each.place not in worst
    )
    world.diagnostics.extend(kept_at_exit(world, lambda wait: tuple(spun_beside(wait, world))))


def _diagnostics(wait: OutsideWait, world: RosWorld) -> Iterator[Diagnostic]:
    if isinstance(wait.client, Instance):
        yield from _unended(wait, wait.client, world)
        return
    if wait.client is None:
        yield from _unwritten(wait, world)
        return
    if not isinstance(wait.client, EntityState):
        return
    for node, what in _needed(wait, wait.client, world):
        if not any(node is spun for spun in (*wait.spun, *spun_beside(wait, world))):
            yield _unanswered(wait, wait.client, what)
            return


def _may_be_spun_elsewhere(node: Instance) -> bool:
    state = node.state
    return not isinstance(state, NodeState) or state.ghost is not None or bool(state.more)


def _unended(wait: OutsideWait, thing: Instance, world: RosWorld) -> Iterator[Diagnostic]:
    """Nothing completes a future, or only callbacks that are not served meanwhile end the wait."""
    spun = (*wait.spun, *spun_beside(wait, world))
    if wait.call == JOIN:
        found = tuple(never_joined(wait, world, spun))
        yield from found or joined_while_ok(wait, world)
        return
    name = thing.hint or thing.class_name
    words = frozenset({Word.PUT if wait.call == 'Queue.get' else Word.SET})
    wakings = [each for each in _wakings_of(thing, world) if each.word in words]
    if not wakings and id(thing) in world.interruptible:
        return
    if id(thing) in world.given or uncalled_wakers(world, name, words, thing.place):
        return
    doers = [waking.by for waking in wakings]
    nodes = [doer.node for doer in doers if isinstance(doer, EntityState)]
    if len(nodes) < len(doers) or any(node is each for node in nodes for each in spun):
        return
    # An object without users may be meant to keep the program.
    is_meant = not nodes and not wait.in_thread and wait.call != 'Queue.get'
    yield _waits_for_ever(wait, name, has_node=bool(nodes), is_meant=is_meant)


def _wakings_of(thing: Instance, world: RosWorld) -> Sequence[Waking]:
    """What is done to it, or where nothing is, to others of its place, as for callbacks."""
    known = world.wakings.get(id(thing))
    if known is not None:
        return known
    return world.done_alike(id(thing), world.made_at.get((thing.cls, thing.place), ()))


def _waits_for_ever(wait: OutsideWait, name: str, *, has_node: bool, is_meant: bool) -> Diagnostic:
    what = 'nothing ends that wait'
    if has_node:
        what = 'nothing spins the node whose callback would end it'
    return Diagnostic(
        severity=Severity.WARNING if is_meant else Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{wait.call} waits for {name}, but {what}: it waits forever',
        help='spin the node in a thread before, and only there'
        if has_node
        else 'end it somewhere, or give it a time-out',
    )


def _unwritten(wait: OutsideWait, world: RosWorld) -> Iterator[Diagnostic]:
    """Only callbacks write what a loop looks at, and they are not served meanwhile."""
    if any(_writes(state.effects, wait.names) for state in world.activities):
        return
    served = (*world.entities, *world.builtins)
    nodes = [each.node for each in served if _writes(each.effects, wait.names)]
    is_spun = any(node is each for node in nodes for each in spun_beside(wait, world))
    if not nodes or is_spun or data_is_written_elsewhere(world, wait.names) is not None:
        return
    yield _waits_for_ever(wait, min(wait.names), has_node=True, is_meant=False)


def _writes(effects: EffectLog | None, names: frozenset[str]) -> bool:
    return effects is not None and any(access.name in names for access in effects.writes)


def _needed(
    wait: OutsideWait, client: EntityState, world: RosWorld
) -> Iterator[tuple[Instance, str]]:
    """The nodes that must be spun, with what each is needed for."""
    if wait.call == RATE:
        yield client.node, 'has it'
        return
    yield client.node, 'must take it'
    if client.kind not in SERVER_KINDS:
        return
    kind, key = SERVER_KINDS[client.kind], client.key
    servers = [e for e in world.entities if e.kind is kind and _is_same(e.key, key)]
    if len(servers) == 1:
        yield servers[0].node, 'must give it'


def _is_same(one: Value | None, other: Value | None) -> bool:
    return isinstance(one, Const) and isinstance(other, Const) and one.value == other.value


def spun_beside(wait: OutsideWait, world: RosWorld) -> Iterator[Instance]:
    """The nodes that other threads spin."""
    for _, nodes in spins_beside(wait, world):
        yield from nodes


def spins_beside(
    wait: OutsideWait, world: RosWorld
) -> Iterator[tuple[Spin, tuple[Instance, ...]]]:
    """The spins of other threads, with their nodes; threads are not distinguished."""
    for number, spin in enumerate(world.spins.values()):
        is_later = wait.begun is not None and number >= wait.begun
        is_beside = (spin.in_thread or wait.in_thread) and not is_later
        if is_beside and not is_over(spin, number, wait, world):
            entries = spin.executor.slots.get('__nodes__', ())
            added = [each for entry in entries for each in options_of(entry)]
            yield spin, (*spin.nodes, *(each for each in added if isinstance(each, Instance)))


def _unanswered(wait: OutsideWait, client: EntityState, what: str) -> Diagnostic:
    key = client.key
    name = f' of {key.value!r}' if isinstance(key, Const) else ''
    awaited = 'a timer' if wait.call == RATE else f'the answer{name}'
    is_answer = client.kind in SERVER_KINDS
    if not is_answer and wait.call != RATE:
        topic = client.topic
        awaited = 'simulated time' if topic == '/clock' else f'what comes on {topic}'
    return Diagnostic(
        severity=Severity.ERROR,
        slug='nobody-spins',
        place=wait.place,
        message=f'{in_words(wait.call)} waits for {awaited} while nothing spins the node that '
        f'{what}: it waits forever',
        help='use time.sleep, or spin the node in a thread before, and only there'
        if wait.call == RATE
        else 'spin the node in a thread before, and only there'
        if not is_answer
        else 'spin the nodes concerned in a thread before, and only there, or wait by '
        'spin_until_future_complete on an executor that has them',
    )
