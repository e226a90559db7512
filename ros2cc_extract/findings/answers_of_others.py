"""What a kept promise assumes of other programs: that the services it waits for answer."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.wording import listing
from ros2cc_extract.spec.client_server_pairs import asked_by, server_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Activity, Callback, EntityKind, Spec

UNTIL_THERE = ('wait_for_service', 'wait_for_server')
"""Calls that wait until a node offers the service or the action."""


def waited_until_there(
    unit: Spec, earlier: tuple[Blocking, ...], block: Blocking, client: Callback
) -> bool:
    """
    Whether the code has waited for the server to be there, in its set-up or before it asks.

    A request that is sent before its server is known is lost and never answered.

    :param earlier: what the same callback waits for.
    :param client: the client that it asks by.
    """
    return block.call in UNTIL_THERE or any(
        each.call in UNTIL_THERE and each.on == client.name for each in (*unit.set_up, *earlier)
    )


def answers_assumed(unit: Spec) -> str:
    """
    Say which answers a unit waits for without a time-out that none of its nodes gives.

    :return: the end of a sentence, as ``as long as service 'plan' answers``; empty without any.
    """
    waits = list(_waits_for_others(unit))
    names = dict.fromkeys(_words(client) for client, _, _ in waits)
    if not names:
        return ''
    verb = 'answers' if len(names) == 1 else 'answer'
    known = all(waited_until_there(unit, earlier, block, c) for c, earlier, block in waits)
    is_there = '' if known else ' from the first request on'
    return f'as long as {listing(names, 3)} {verb}{is_there}'


def _waits_for_others(unit: Spec) -> Iterator[tuple[Callback, tuple[Blocking, ...], Blocking]]:
    doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
    for doer in doers:
        for block in (each for each in doer.blocking if each.call not in UNTIL_THERE):
            for client in asked_by(block, unit.callbacks):
                if server_of(client, unit.callbacks) is None:
                    yield client, doer.blocking, block


def _words(client: Callback) -> str:
    kind = 'service' if client.entity is EntityKind.CLIENT else 'action'
    return (
        f'{kind} {client.key!r}' if isinstance(client.key, str) else f'the {kind} of {client.name}'
    )
