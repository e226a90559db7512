"""
Messages by which one process ends a wait of another one, where these are put into one unit.

A unit alone assumes that messages come. If all senders of what ends a wait are known, it
lasts until one of them has come to its send; they in turn wait for their own messages.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.identity_memo import once
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Act, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Activity, Callback, EntityKind, Spec
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.circles.rewritten_waits import with_waits
from ros2cc_extract.spec.system.model import Process, System

Doer = Callback | Activity


@dataclass(frozen=True)
class Sent:
    """A message that a callback or an activity sends."""

    doer: Doer
    act: Act


def ended_by_messages(block: Blocking, callbacks: Mapping[str, Callback]) -> tuple[Callback, ...]:
    """List the subscriptions whose messages alone end a wait; none where others may end it."""
    is_open = block.seconds is not None or block.escapes is not None or block.initial
    if is_open or (block.needs is Needs.ALL and len(block.wakers) > 1):
        return ()
    by = [callbacks.get(waker.by) for waker in block.wakers]
    heard = [each for each in by if each is not None and each.entity is EntityKind.SUBSCRIPTION]
    return tuple(heard) if len(heard) == len(by) else ()


@once
def senders_in(system: System) -> dict[str, frozenset[str]]:
    """The processes that send on each topic, if all that may are known, and callbacks do it."""
    if not system.is_whole:
        return {}
    found: dict[str, frozenset[str]] = {}
    for each in (each for each in system.connections if each.what == 'topic'):
        ends = each.of_kind(EndpointKind.PUBLISHER)
        if ends and all(end.endpoint.written in _sent_by(end.process) for end in ends):
            found[each.name] = frozenset(end.process.name for end in ends)
    return found


def _sent_by(process: Process) -> Collection[object]:
    """What the callbacks of a process send; nothing is known where they send what is not."""
    names = {act.name for doer in _doers(process.units) for act in doer.publishes}
    return names if all(isinstance(name, str) for name in names) else ()


def _doers(units: Iterable[Spec]) -> Iterator[Doer]:
    for unit in units:
        yield from unit.callbacks
        yield from unit.activities


def with_messages(parts: Sequence[Spec], topics: Collection[str]) -> list[Spec]:
    """
    Let waits that messages end wait for the senders.

    :param topics: of which all senders are among ``parts``, under their names in the system.
    """
    callbacks = {each.name: each for part in parts for each in part.callbacks}
    sent: dict[str, list[Sent]] = defaultdict(list)
    for doer in _doers(parts):
        for act in (act for act in doer.publishes if act.name in topics):
            sent[str(act.name)].append(Sent(doer, act))

    def rewritten(doer: Doer, block: Blocking) -> tuple[Blocking, ...]:
        heard = {each.key for each in ended_by_messages(block, callbacks)}
        names = {key for key in heard if isinstance(key, str) and sent.get(key)}
        if not heard or names != heard:
            return (block,)
        asked = set((block.answer_to or '').split(', '))
        return (*_sending(block, tuple(sorted(names)), sent, asked), block)

    return with_waits(parts, rewritten)


def _sending(
    block: Blocking, names: tuple[str, ...], sent: Mapping[str, Sequence[Sent]], asked: set[str]
) -> tuple[Blocking, ...]:
    """
    Waits for messages, before each of which there is the one that lets its only sender run.

    :param asked: topics on which the waiting code has sent before.
    """
    found: list[Blocking] = []
    known = set(asked)
    while names and known.isdisjoint(names):
        known.update(names)
        senders = [each for name in names for each in sent[name]]
        found.insert(0, _until_sent(block, names, senders))
        keys = {_heard(each.doer) for each in senders}
        only = keys.pop() if len(keys) == 1 else None
        names = (only,) if only is not None and only in sent else ()
    return tuple(found)


def _until_sent(block: Blocking, names: Sequence[str], senders: Sequence[Sent]) -> Blocking:
    what = f'a message on {", ".join(names)}'
    wakers = tuple(
        Waker(
            by=each.doer.name,
            after=each.act.after,
            conditional=each.act.conditional,
            source=each.act.source,
        )
        for each in senders
    )
    first = senders[0]
    is_open = all(each.act.conditional for each in senders)
    why = Unknown(f'{first.doer.name} may not send it', first.act.source) if is_open else None
    return replace(
        block, on=what, resource=what, wakers=wakers, needs=Needs.ONCE, signals=1, forgets=False,
        escapes=why, answer_to=None, unsent=None,
    )  # fmt: skip


def _heard(doer: Doer) -> str | None:
    """The topic whose messages alone let it run."""
    if not isinstance(doer, Callback) or doer.entity is not EntityKind.SUBSCRIPTION:
        return None
    return doer.key if isinstance(doer.key, str) else None
