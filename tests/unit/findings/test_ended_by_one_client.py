"""CC101: an event that several done-callbacks of one client set, in the group of who waits."""

from __future__ import annotations

from finding_units import at, callback, found, threads, timer, unit

from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.model import Callback, EntityKind


def drives(*wakers: str) -> Callback:
    wait = Blocking(
        call='Event.wait',
        source=at(41),
        on='finished',
        resource='finished',
        wakers=tuple(Waker(by=each, after=0) for each in wakers),
    )
    return timer('drive', 'arm_default', blocking=(wait,))


def says(client_group: str, other: str = 'go') -> list[str]:
    clients = [callback('go_client', EntityKind.ACTION_CLIENT, client_group, key='go')]
    if other != 'go':
        clients.append(callback('other_client', EntityKind.ACTION_CLIENT, 'other', key=other))
    done = [
        callback(name, EntityKind.DONE_CALLBACK, 'no_group', key=key, groupless=True)
        for name, key in (('on_response', 'go'), ('on_result', other))
    ]
    spec = unit(threads(6), drives('on_response', 'on_result'), *clients, *done)
    return [each for each in found(spec) if each.startswith('CC101')]


def test_all_answers_come_by_a_client_of_the_group() -> None:
    assert says('arm_default') == ['CC101:41']


def test_the_client_is_in_another_group() -> None:
    assert says('other') == []


def test_another_client_may_end_it_too() -> None:
    assert says('arm_default', 'come') == []
