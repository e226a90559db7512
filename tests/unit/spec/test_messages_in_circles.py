"""Who sends the message that ends a wait, in units of several processes."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Act, Blocking, Waker
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.spec.system.circles.messages import with_messages
from ros2cc_extract.spec.system.circles.rewritten_waits import with_waits
from tests.unit.findings.finding_units import calls, client, subscription, threads, timer, unit

REPLIED = Blocking(call='Event.wait', resource='replied', wakers=(Waker(by='on_reply', after=0),))
ON_REPLY = subscription('on_reply', key='/replies')
OPEN = ('/replies', '/orders')


def sends(topic: str, **facts: object) -> tuple[Act, ...]:
    return (Act(name=topic, **facts),)  # type: ignore[arg-type]


def supplier(**facts: object) -> Spec:
    asks = calls('details')
    on_order = subscription(
        'on_order', key='/orders', blocking=asks, publishes=sends('/replies', after=1, **facts)
    )
    return unit(threads(2), on_order, client('details', 'other'))


def requester(*others: Callback, block: Blocking = REPLIED) -> Spec:
    return unit(threads(3), timer('order', blocking=(block,)), ON_REPLY, *others)


def waits(parts: list[Spec]) -> list[tuple[object, tuple[str, ...]]]:
    """What ``order`` waits for, and who ends that, with the waits before."""
    (order,) = (c for part in parts for c in part.callbacks if c.name == 'order')
    return [
        (block.resource, tuple(f'{waker.by} {waker.after}' for waker in block.wakers))
        for block in order.blocking
    ]


def test_a_wait_for_a_message_waits_for_its_sender_first() -> None:
    asked = replace(REPLIED, answer_to='/orders')
    assert waits(with_messages([requester(block=asked), supplier()], OPEN)) == [
        ('a message on /replies', ('on_order 1',)),
        ('replied', ('on_reply 0',)),
    ]


def test_a_sender_that_only_a_message_starts_waits_for_that_one() -> None:
    begins = timer('begin', publishes=sends('/orders'))
    assert waits(with_messages([requester(begins), supplier()], OPEN)) == [
        ('a message on /orders', ('begin 0',)),
        ('a message on /replies', ('on_order 1',)),
        ('replied', ('on_reply 0',)),
    ]


def test_where_others_may_send_nothing_is_claimed() -> None:
    parts = [requester(), supplier()]
    assert with_messages(parts, ('/orders',)) == parts


def test_what_others_than_messages_may_end_is_left_as_it_is() -> None:
    either = replace(REPLIED, wakers=(*REPLIED.wakers, Waker(by='stop')))
    timed = replace(REPLIED, seconds=1.0)
    for block in (either, timed, replace(REPLIED, escapes=Unknown('somebody'))):
        parts = [requester(timer('stop'), block=block), supplier()]
        assert with_messages(parts, OPEN) == parts


def test_a_message_that_may_not_be_sent_leaves_the_wait_open() -> None:
    found = with_messages([requester(), supplier(conditional=True)], OPEN)
    first = found[0].callbacks[0].blocking[0]
    assert first.escapes == Unknown('on_order may not send it')


def test_what_lies_behind_a_wait_lies_behind_all_that_stand_for_it() -> None:
    first, second = (Blocking(call=name, resource=name) for name in ('first', 'second'))
    ends = Waker(by='drive', after=1)
    drive = timer('drive', blocking=(first, second), publishes=sends('/out', after=2))
    waiting = timer('other', blocking=(replace(REPLIED, wakers=(ends,)),))
    [part] = with_waits(
        [unit(threads(2), drive, waiting)],
        lambda _, block: (block, block) if block is first else (block,),
    )
    assert part.callbacks[0].blocking == (first, first, second)
    assert part.callbacks[0].publishes == sends('/out', after=3)
    assert part.callbacks[1].blocking[0].wakers == (replace(ends, after=2),)
