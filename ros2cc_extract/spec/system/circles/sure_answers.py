"""
Waits of joined units that end for sure, so that a model need not show them.

A callback that waits for nothing comes to its end. An answer is sure if its giver, and
its taker, come to their ends, and all others of their groups do: nothing keeps them from
running, since joined units have threads enough. What waits only for such answers comes to its end
too, and so on. No circle is among them: each rests on those that were found before it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from ros2cc_extract.spec.client_server_pairs import asked_by, servers_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.joined_executors import Joined, enough_threads, without_idle
from ros2cc_extract.spec.model import Callback, GroupType, Spec


def without_sure_waits(joined: Joined) -> Joined | None:
    """The same without waits that end for sure; ``None`` where no other ones are left."""
    spec = joined.spec
    ending = frozenset(_ending(spec))
    if not ending:
        return joined

    def left(blocks: Collection[Blocking]) -> tuple[Blocking, ...]:
        return tuple(block for block in blocks if not _is_sure(block, spec, ending))

    less = replace(
        spec,
        callbacks=tuple(replace(each, blocking=left(each.blocking)) for each in spec.callbacks),
    )
    less = without_idle(less)
    if not any(block.seconds is None for each in less.callbacks for block in each.blocking):
        return None if not less.activities else joined
    number = min(enough_threads(less.callbacks, less.groups), len(spec.executor.threads))
    threads = spec.executor.threads[:number]
    names = {each.name for each in less.callbacks}
    return replace(
        joined,
        spec=replace(less, executor=replace(spec.executor, threads=threads)),
        parts=tuple(tuple(name for name in part if name in names) for part in joined.parts),
    )


def _ending(spec: Spec) -> Iterator[str]:
    """Callbacks that come to their end whenever they run."""
    found: set[str] = set()
    while True:
        more = [
            each.name
            for each in spec.callbacks
            if each.name not in found and _ends(each, spec, found)
        ]
        if not more:
            yield from found
            return
        found.update(more)


def _ends(callback: Callback, spec: Spec, ending: Collection[str]) -> bool:
    is_known = callback.unresolved is None and not callback.locks
    return is_known and all(
        block.seconds is not None or _is_sure(block, spec, ending) for block in callback.blocking
    )


def _is_sure(block: Blocking, spec: Spec, ending: Collection[str]) -> bool:
    """Whether it waits for one answer alone, which comes."""
    clients = asked_by(block, spec.callbacks)
    if len(clients) != 1 or block.held or block.escapes is not None or block.initial:
        return False
    by_name = {each.name: each for each in spec.callbacks}
    names = {waker.by for waker in block.wakers} | {block.on}
    takers = [by_name.get(name) for name in names if isinstance(name, str)]
    is_sent = all(not waker.conditional for waker in block.wakers)
    servers = servers_of(clients[0], spec.callbacks)
    is_there = all(not each.conditional and each.alternative is None for each in servers)
    needed = [*takers, clients[0], *servers]
    is_answered = is_sent and is_there and len(servers) == 1
    return is_answered and all(_comes(each, spec, ending) for each in needed)


def _comes(callback: Callback | None, spec: Spec, ending: Collection[str]) -> bool:
    """Whether it runs once something has arrived for it, and ends."""
    if callback is None or callback.name not in ending or callback.destroyed:
        return False
    if callback.groupless:
        return True
    group = spec.group_of(callback)
    if group.type is GroupType.REENTRANT:
        return group.unresolved is None
    members = (each.name for each in spec.callbacks if each.group == group.name)
    return group.unresolved is None and all(name in ending for name in members)
