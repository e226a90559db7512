"""
A thread spins a node for a while that another thread's executor serves: the node is lost to that.

``rclpy.spin_once`` and ``rclpy.spin_until_future_complete`` add the node to an executor of their
own, which takes it out of the one that has it, and take it out again when they are done. What a
callback or ``main`` does is reported where it is followed. A thread may start before the other
executor gets the node. Sources: rclpy 7.1.6 and 9.1.2, ``__init__.py``, ``node.py``
(``Node.executor``), ``executors.py`` (``add_node``, ``remove_node``).
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import process_of
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld, Spin
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.extract.static.python.values.values import Instance, options_of

SLUG = 'node-taken-out'


def note_taken_by_threads(world: RosWorld) -> None:
    """Report, after all was followed, nodes that a thread takes out of an executor."""
    reported = {each.place for each in world.diagnostics if each.slug == SLUG}
    found = (each for each in _thefts(world) if each.place not in reported)
    world.diagnostics.extend(dict.fromkeys(found))


def _thefts(world: RosWorld) -> Iterator[Diagnostic]:
    spins = list(world.spins.values())
    for number, spin in enumerate(spins):
        if not spin.in_thread or spin.for_ever or not spin.takes:
            continue
        for other in spins:
            if _is_beside(spin, number, other) and any(_robbed(spin, other)):
                yield _reported(spin, other)
                break


def _is_beside(spin: Spin, number: int, other: Spin) -> bool:
    """Whether ``other`` is begun later, of another executor, while the thread may still spin."""
    is_other = other.executor is not spin.executor and other.thread != spin.thread
    goes_on = other.for_ever or other.repeated
    is_apart = number < other.over or process_of(spin.by) is not process_of(other.by)
    return is_other and goes_on and not is_apart and not exclusive(spin.path, other.path)


def _robbed(spin: Spin, other: Spin) -> Iterator[bool]:
    entries = other.executor.slots.get('__nodes__', ())
    added = (each for entry in entries for each in options_of(entry))
    served = [*other.nodes, *(each for each in added if isinstance(each, Instance))]
    yield from (node in served for node in spin.nodes)


def _reported(spin: Spin, other: Spin) -> Diagnostic:
    name = other.executor.hint or 'the executor'
    kind = getattr(other.executor.state, 'kind', 'executor')
    return Diagnostic(
        severity=Severity.WARNING,
        slug=SLUG,
        place=spin.place,
        message=f'{spin.how} in a thread removes the node from {name} ({kind}, '
        f'{other.executor.place}), which serves it meanwhile; then the node is in no executor '
        'until it is added again',
        help=f'leave this out, {name} is spun by another thread: wait for the future by an Event '
        'that its done-callback sets',
    )
