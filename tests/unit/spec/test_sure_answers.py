"""What joined units need not show: waits that end for sure."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Act, Blocking, Waker
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Callback, EntityKind, Spec
from ros2cc_extract.spec.system.circles.sure_answers import without_sure_waits
from tests.unit.findings.finding_units import (
    callback,
    calls,
    client,
    exclusive,
    outside,
    reentrant,
    service,
    threads,
    timer,
    unit,
)

GROUPS = tuple(exclusive(name) for name in ('arm_default', 'other', 'third', 'answers'))


def of(*callbacks: Callback) -> Joined:
    groups = (*GROUPS, reentrant('no_group', groupless=True))
    spec = unit(threads(4), *callbacks, groups=groups)
    return Joined(spec=spec, parts=(tuple(each.name for each in callbacks),))


def waiting(joined: Joined | None) -> dict[str, list[object]]:
    """Who still waits, and for what."""
    spec: Spec | None = joined.spec if joined else None
    callbacks = spec.callbacks if spec else ()
    return {c.name: [b.on for b in c.blocking] for c in callbacks if c.blocking}


ON_BACK = service('on_back', 'other', key='back')
BACK = client('back', 'answers', key='back')
TICK = timer('tick', blocking=calls('back'))


def test_an_answer_of_who_waits_for_nobody_is_sure() -> None:
    assert without_sure_waits(of(TICK, BACK, ON_BACK)) is None


def test_an_answer_that_is_served_where_somebody_waits_is_not() -> None:
    joined = of(TICK, BACK, replace(ON_BACK, group='arm_default'))
    assert waiting(without_sure_waits(joined)) == {'tick': ['back']}
    taken = of(TICK, replace(BACK, group='arm_default'), ON_BACK)
    assert waiting(without_sure_waits(taken)) == {'tick': ['back']}


def test_what_rests_on_sure_answers_alone_is_sure() -> None:
    on_plan = service('on_plan', 'third', key='plan', blocking=calls('back'))
    plan = client('plan', 'other', key='plan')
    drive = timer('drive', blocking=calls('plan'))
    assert without_sure_waits(of(drive, plan, on_plan, BACK, ON_BACK)) is None


def test_a_circle_stays_and_what_it_does_not_need_goes() -> None:
    there = service('on_there', 'arm_default', key='there', blocking=calls('here'))
    here = service('on_here', 'other', key='here', blocking=calls('there', call='client.call'))
    clients = (client('here', 'third', key='here'), client('there', 'third', key='there'))
    sure = timer('tick', 'answers', blocking=calls('back'))
    more = (sure, client('back', 'third', key='back'), service('on_back', 'third', key='back'))
    found = without_sure_waits(of(there, here, *clients, *more))
    assert waiting(found) == {'on_there': ['here'], 'on_here': ['there']}
    assert found is not None
    assert [each.name for each in found.spec.callbacks] == ['on_there', 'on_here', 'here', 'there']
    assert found.parts == (('on_there', 'on_here', 'here', 'there'),)


def test_what_is_not_known_is_not_sure() -> None:
    locked = replace(ON_BACK, locks=(Act(name='lock'),))
    odd = replace(ON_BACK, unresolved=Unknown('its code is not available'))
    skipped = replace(ON_BACK, conditional=True)
    for server in (locked, odd, skipped):
        assert waiting(without_sure_waits(of(TICK, BACK, server))) == {'tick': ['back']}
    twice = service('second', 'third', key='back')
    assert waiting(without_sure_waits(of(TICK, BACK, ON_BACK, twice))) == {'tick': ['back']}
    held = timer('tick', blocking=calls('back', held=('lock',)))
    assert waiting(without_sure_waits(of(held, BACK, ON_BACK))) == {'tick': ['back']}


def test_an_event_that_a_done_callback_sets_in_any_case_is_as_sure_as_its_answer() -> None:
    done = outside('done', EntityKind.DONE_CALLBACK, key='back')
    for conditional, left in ((False, {}), (True, {'tick': ['done']})):
        wakers = (Waker(by='done', after=0, conditional=conditional),)
        block = Blocking(call='Event.wait', on='done', resource='answered', wakers=wakers)
        joined = of(timer('tick', blocking=(block,)), BACK, ON_BACK, done)
        assert waiting(without_sure_waits(joined)) == left


def test_what_a_message_wakes_stays() -> None:
    heard = callback('heard', EntityKind.SUBSCRIPTION, 'third', key='/heard')
    block = Blocking(call='Event.wait', resource='heard', wakers=(Waker(by='heard', after=0),))
    joined = of(timer('tick', blocking=(block,)), heard)
    assert waiting(without_sure_waits(joined)) == {'tick': [None]}
