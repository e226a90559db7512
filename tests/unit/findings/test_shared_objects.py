"""Objects that callbacks of several nodes, or of several executors, have in common."""

from __future__ import annotations

from dataclasses import replace

from finding_units import DEFAULT, at, exclusive, found, threads, timer, unit

from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Callback, Spec


def adds(name: str, *locks: str) -> Callback:
    return booking('book', name, 'arm', 'arm_default', *locks)


def booking(does: str, name: str, node: str, group: str, *locks: str) -> Callback:
    change = Access(name=name, source=at(30), locks=locks, update=True)
    return timer(does, group, node=node, cls='Arm', writes=(change,))


def program(*callbacks: Callback, **facts: object) -> list[Spec]:
    """Each callback on an executor of its own, all but the first in a thread."""
    units = []
    for number, each in enumerate(callbacks):
        spun = {'spun': 'spin', 'in_thread': number > 0, **facts}
        executor = replace(threads(1), **spun)
        own = replace(each, node=f'arm_{number}')
        made = unit(executor, own)
        units.append(replace(made, name=f'arm_{number}', entry='arm.py:main', nodes=(own.node,)))
    return units


def told(units: list[Spec]) -> list[str]:
    return [f.code for f in findings_of(units, []) if f.code.startswith('CC3')]


def test_two_executors_change_one_helper_object():
    assert told(program(adds('Ledger.total'), adds('Ledger.total'))) == ['CC301']
    assert told(program(adds('ledger.total'), adds('ledger.total'))) == ['CC301']


def test_two_objects_and_attributes_of_two_nodes_are_not_shared():
    assert told(program(adds('Ledger.total'), adds('Ledger#2.total'))) == []
    assert told(program(adds('Arm.total'), adds('Arm.total'))) == []


def test_one_lock_keeps_executors_apart():
    locked = adds('Ledger.total', 'guard')
    assert told(program(locked, locked)) == []


def test_executors_that_do_not_run_together_disturb_nobody():
    both = adds('Ledger.total'), adds('Ledger.total')
    assert told(program(*both, in_thread=False)) == []
    assert told(program(*both, alternative='main')) == []
    first, second = program(*both)
    assert told([first, replace(second, entry='arm.py:other')]) == []


def test_two_nodes_of_one_pool_change_one_helper_object():
    def codes(name: str, *locks: str) -> list[str]:
        one = booking('book', name, 'arm', 'arm_default', *locks)
        other = booking('pay', name, 'hand', 'hand_default', *locks)
        groups = (DEFAULT, exclusive('hand_default', node='hand'))
        said = found(unit(threads(2), one, other, groups=groups))
        return [code for code in said if code.startswith('CC3')]

    assert codes('Ledger.total') == ['CC301:30 warning']
    assert codes('Ledger.total', 'guard') == []
    assert codes('Arm.total') == []


def test_one_executor_goes_over_what_another_changes():
    loop = Access(name='Board.entries', source=at(20), iterates='dict')
    reader = timer('show', 'arm_default', node='arm', cls='Arm', reads=(loop,))
    assert told(program(reader, adds('Board.entries'))) == []
    change = Access(name='Board.entries', source=at(30), update=True, in_place=True)
    writer = timer('note', 'arm_default', node='arm', cls='Arm', writes=(change,))
    assert told(program(reader, writer)) == ['CC301']
