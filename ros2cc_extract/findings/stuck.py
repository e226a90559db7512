"""Who stands still at the end of a run of the model, in which wait of the source, and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ros2cc_extract.findings.hang import Standstill, open_waits
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.findings.waits import Wait, WaitKind, kind_of
from ros2cc_extract.findings.words import group_words, listing, plural
from ros2cc_extract.findings.workers import is_one_thread
from ros2cc_extract.spec.deeds import Blocking, Needs
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.spec.partners import is_client, server_of
from ros2cc_extract.verify.caveats import block_at
from ros2cc_extract.verify.evidence import Evidence


@dataclass(frozen=True)
class Stuck:
    """
    A wait that has not ended when nothing moves any more.

    :param wait: as the source has it.
    :param enders: names of those that could end it, and of the service that answers a client.
    """

    wait: Wait
    standstill: Standstill
    enders: tuple[str, ...]

    @property
    def callback(self) -> Callback:
        """Who waits."""
        return self.wait.caller

    @property
    def what(self) -> str:
        """What is waited for, in words; empty where the wait says it all."""
        if self.standstill.is_for_lock:
            return f'the lock of {self.standstill.needed}'
        block = self.wait.block
        return block.resource or (block.on if isinstance(block.on, str) else '')


def stuck_in(run: Evidence, context: Context) -> list[Stuck]:
    """Give all that stands still at the end of a run, in the order in which it began to."""
    found = []
    for standstill in open_waits(run.moments):
        callback = context.by_name.get(standstill.who)
        block = _block(callback, standstill, context) if callback is not None else None
        if callback is not None and block is not None:
            enders = tuple(_with_servers(standstill.enders, context))
            found.append(Stuck(Wait(callback, block, kind_of(block)), standstill, enders))
    return found


def _with_servers(names: Iterable[str], context: Context) -> Iterator[str]:
    for name in names:
        yield name
        ender = context.by_name.get(name)
        server = server_of(ender, context.unit.callbacks) if ender is not None else None
        if server is not None:
            yield server.name


def _block(callback: Callback, standstill: Standstill, context: Context) -> Blocking | None:
    """Give the wait of the source; of the taking of a lock the first wait that is known."""
    block = block_at(context.unit, callback, standstill.wait)
    waits = (b for b in callback.blocking if kind_of(b) is not WaitKind.SLEEP)
    return block or next(waits, None)


def why_stuck(stuck: Stuck, others: Sequence[Stuck], context: Context) -> str:
    """Say why nobody ends a wait: the first cause that holds for all that could."""
    enders = [context.by_name[name] for name in stuck.enders if name in context.by_name]
    if not enders:
        return 'nobody ends that wait'
    waiting = [each for each in others if each.callback in enders and each is not stuck]
    if waiting:
        return listing(_waits_too(each) for each in waiting)
    if is_one_thread(context.unit.executor):
        on_it = stuck.callback.display_name
        return f'{_names(enders)} cannot run: {on_it} holds the only thread of the executor'
    shut = [ender for ender in enders if _keeper(ender, others, context) is not None]
    if len(shut) == len(enders) or any(is_client(ender) for ender in shut):
        return listing(_shut_out(ender, others, context) for ender in shut)
    if _is_full(others, context):
        threads = plural(len(context.unit.executor.threads), 'thread')
        return f'no thread is left to run {_names(enders)}: {threads} in all, and each waits'
    early = 'comes too early, or is used up by another wait'
    if stuck.wait.block.needs is not Needs.EACH:
        early = 'is not sure to come'
    return f'what {_names(enders)} does for it {early}'


def _names(callbacks: Sequence[Callback]) -> str:
    return listing(callback.display_name for callback in callbacks)


def _waits_too(stuck: Stuck) -> str:
    what = f' for {stuck.what}' if stuck.what else ''
    return f'{stuck.callback.display_name}, which ends it, waits itself{what}'


def _keeper(ender: Callback, others: Sequence[Stuck], context: Context) -> Callback | None:
    """Who keeps the group of ``ender`` closed while it waits."""
    group = context.exclusive_group(ender)
    keepers = (each.callback for each in others if group is not None)
    return next((k for k in keepers if group is not None and k.group == group.name), None)


def _shut_out(ender: Callback, others: Sequence[Stuck], context: Context) -> str:
    keeper = _keeper(ender, others, context)
    assert keeper is not None, 'asked of those that are shut out'
    return (
        f'{ender.display_name} is in {group_words(context.group_of(ender))}, which is closed '
        f'while {keeper.display_name} waits'
    )


def _is_full(others: Sequence[Stuck], context: Context) -> bool:
    held = {each.standstill.thread for each in others if not each.standstill.spins}
    return held >= set(context.unit.executor.threads)
