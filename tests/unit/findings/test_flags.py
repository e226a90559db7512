"""Flags that keep others out, and flags that do not."""

from __future__ import annotations

from dataclasses import replace

from finding_units import at, callback, found, outside, service, threads, timer, unit, updates

from ros2cc_extract.spec.effects import FLAG, FOUND_FALSE, FOUND_NONE, Access, Act, Blocking
from ros2cc_extract.spec.model import Callback, EntityKind

BUSY = 'Arm.busy' + FLAG


def flag(line: int, *locks: str, rests: bool = False) -> Access:
    return Access(name='Arm.busy', source=at(line), locks=locks, rests=rests)


def goal(*locks: str, group: str = 'arm_default') -> Callback:
    return callback(
        'on_goal',
        EntityKind.ACTION_SERVER,
        group,
        reads=(flag(20, *locks),),
        writes=(flag(21, *locks, BUSY, rests=True),),
        locks=tuple(Act(name=lock, source=at(19)) for lock in locks),
    )


def execute(*, down: bool = True, count: int = 30) -> Callback:
    given_back = (flag(35, BUSY),) if down else (flag(35),)
    writes = (*updates('Arm.steps', count, BUSY), *given_back)
    return outside('execute', EntityKind.ACTION_EXECUTE, writes=writes)


def told(*callbacks: Callback) -> list[str]:
    return [code for code in found(unit(threads(3), *callbacks)) if code.startswith('CC3')]


def test_a_goal_that_is_let_in_alone_does_not_overlap_itself() -> None:
    assert told(goal('lock'), execute()) == []
    assert told(goal(), execute()) == []


def put_up_by_execute() -> Callback:
    wait = Blocking(call='await', source=at(32))
    reads = (Access(name='Arm.target', source=at(33), locks=(BUSY,)),)
    target = Access(name='Arm.target', source=at(31), locks=(BUSY,))
    writes = (flag(30, BUSY), target, flag(35, BUSY))
    kind = EntityKind.ACTION_EXECUTE
    return outside('execute', kind, reads=reads, writes=writes, blocking=(wait,), coroutine=True)


def test_execute_may_put_up_the_flag_where_goals_come_one_by_one() -> None:
    asks = callback('on_goal', EntityKind.ACTION_SERVER, 'arm_default', reads=(flag(20),))
    one_by_one = found(unit(threads(1), asks, put_up_by_execute()))
    assert [code for code in one_by_one if code.startswith('CC3')] == []
    assert told(asks, put_up_by_execute()) == ['CC304:33 warning']


def test_a_flag_that_two_may_find_down_at_once_keeps_nobody_out() -> None:
    assert 'CC304:30 warning' in told(goal(group='free'), execute())
    assert told(goal('lock', group='free'), execute()) == []


def test_a_flag_that_somebody_else_writes_keeps_nobody_out() -> None:
    other = service('on_cancel', 'other', writes=(flag(50),))
    assert 'CC304:30 warning' in told(goal('lock'), execute(), other)


def test_a_test_and_a_setting_in_two_sections_keep_nobody_out() -> None:
    loose = goal('lock', group='free')
    taken = (*loose.locks, Act(name='lock', source=at(20, 30)))
    assert 'CC304:30 warning' in told(replace(loose, locks=taken), execute())


def asked_for_none(line: int, found: str, name: str) -> Callback:
    """It stores zero where it finds ``None``, or nothing true, and counts then."""
    up = Access(
        name='Arm.busy',
        source=at(line),
        locks=(BUSY,),
        rests=True,
        lowers=found == FOUND_NONE,
        found=found,
    )
    writes = (up, *updates('Arm.steps', line + 1, BUSY))
    return callback(name, EntityKind.TIMER, 'arm_default', writes=writes)


def test_a_flag_that_is_zero_keeps_out_those_who_ask_for_none() -> None:
    done = outside('on_done', EntityKind.DONE_CALLBACK, writes=updates('Arm.steps', 40, BUSY))
    by_none = asked_for_none(20, FOUND_NONE, 'tick')
    assert told(by_none, done) == []
    assert 'CC303' in ' '.join(told(by_none, asked_for_none(30, FOUND_FALSE, 'tock'), done))


def test_a_flag_protects_against_those_who_hold_it_only() -> None:
    tick = timer('tick', 'other', writes=updates('Arm.steps', 40))
    assert told(goal('lock'), execute(), tick) == ['CC303:30 warning']


def counted(name: str = 'Arm.running', *, asks: bool = True, looks: bool = False) -> list[str]:
    """A goal callback that asks how many goals run, and an execute callback that counts them."""
    asked = Access(name=name, source=at(20), locks=('lock',), admits=asks)
    goal = callback('on_goal', EntityKind.ACTION_SERVER, 'arm_default', reads=(asked,))
    counts = tuple(
        Access(name=name, source=at(line), locks=('lock',), update=True) for line in (30, 35)
    )
    again = (Access(name=name, source=at(29), locks=('lock',)),) if looks else ()
    run = outside('execute', EntityKind.ACTION_EXECUTE, reads=again, writes=counts)
    run = replace(run, source=goal.source)
    return told(goal, run)


def test_goals_that_are_counted_later_than_they_are_let_in():
    assert counted() == ['CC303:20 warning']


def test_no_admission_where_it_decides_nothing_or_execute_looks_again():
    assert counted(asks=False) == []
    assert counted(looks=True) == []
