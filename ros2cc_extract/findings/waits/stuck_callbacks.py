"""What stands still at the end of a run of the model, in which wait of the source, and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.base.wording import called, listing, plural
from ros2cc_extract.findings.waits.hangs import Standstill, open_waits
from ros2cc_extract.findings.waits.verdicts import PROGRESS, is_of_repeated, refuting_run
from ros2cc_extract.findings.waits.waits import AnyWait, WaitKind, kind_of
from ros2cc_extract.findings.waits.workers import Workers, is_one_thread, workers_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.client_server_pairs import client_before, is_client, server_of
from ros2cc_extract.spec.effects import Blocking, Needs
from ros2cc_extract.spec.model import Activity, Callback
from ros2cc_extract.verify.results.caveats import block_at, taking_at
from ros2cc_extract.verify.results.evidence import Evidence


@dataclass(frozen=True)
class Stuck:
    """
    A wait that has not ended when nothing moves any more.

    :param wait: as the source has it.
    :param enders: names of those that could end it, and of the service that answers a client.
    :param holder: what has the lock that is waited for, in words.
    :param awaited: any other thing that is waited for, in words; empty where it has no name.
    """

    wait: AnyWait
    standstill: Standstill
    enders: tuple[str, ...]
    holder: str = ''
    awaited: str = ''

    @property
    def doer(self) -> Doer:
        """What waits."""
        return self.wait.caller

    @property
    def what(self) -> str:
        """What is waited for, in words; empty where the wait says it all."""
        if self.standstill.is_for_lock:
            return f'the lock of {self.holder}'
        return self.awaited


def stuck_in(run: Evidence, context: Context) -> list[Stuck]:
    """Give all that stands still at the end of a run, in the order in which it began to."""
    found = []
    for standstill in open_waits(run.moments):
        doer = context.doer_by_name.get(standstill.who)
        block = _block(doer, standstill, context) if doer is not None else None
        if doer is not None and block is not None:
            enders = tuple(_with_servers(standstill.enders, context))
            holder = _words_for(standstill.needed, context)
            on = block.resource or (block.on if isinstance(block.on, str) else '')
            wait = AnyWait(doer, block, kind_of(block))
            found.append(Stuck(wait, standstill, enders, holder, _words_for(on, context)))
    return found


def together_with(first: str, stuck: Sequence[Stuck]) -> list[Stuck]:
    """``first`` and those of the others that stand in its way, which begin with it."""
    names = {first}
    while True:
        needed = {name for each in stuck if each.doer.name in names for name in each.enders}
        wider = names | {each.doer.name for each in stuck if each.doer.name in needed}
        if wider == names:
            return sorted(
                (each for each in stuck if each.doer.name in names),
                key=lambda each: each.doer.name != first,
            )
        names = wider


def waits_in_circle(caller: Doer, context: Context) -> bool:
    """Whether all that could end its wait wait themselves, so that no free thread would help."""
    run = refuting_run(PROGRESS, context, caller)
    if run is None or is_of_repeated(caller, context):
        return False
    together = together_with(caller.name, stuck_in(run, context))
    names = {each.doer.name for each in together}
    return bool(together) and all(each.enders and names >= {*each.enders} for each in together)


def _with_servers(names: Iterable[str], context: Context) -> Iterator[str]:
    for name in names:
        yield name
        ender = context.by_name.get(name)
        server = server_of(ender, context.unit.callbacks) if ender is not None else None
        if server is not None:
            yield server.name


def _words_for(name: str, context: Context) -> str:
    callback = context.by_name.get(name)
    return name if callback is None else callback.display_name


def _block(doer: Doer, standstill: Standstill, context: Context) -> Blocking | None:
    """Give the wait of the source, or where it takes the lock; else the first that is known."""
    block = block_at(context.unit, doer, standstill.wait)
    if block is None and standstill.is_for_lock:
        block = taking_at(context.unit, doer, standstill.wait)
    waits = (b for b in doer.blocking if kind_of(b) is not WaitKind.SLEEP)
    return block or next(waits, None)


def why_stuck(stuck: Stuck, others: Sequence[Stuck], context: Context) -> str:
    """Say why nothing ends a wait: the first cause that holds for all that could."""
    enders = [context.doer_by_name[name] for name in stuck.enders if name in context.doer_by_name]
    if not enders:
        return _why_nobody(stuck, context)
    waiting = [each for each in others if each.doer in enders and each is not stuck]
    if waiting:
        return listing(_waits_too(each) for each in waiting)
    if is_for_itself(stuck):
        return 'only another run of it ends that wait, and its runs are one by one'
    served = [ender for ender in enders if isinstance(ender, Callback)]
    holding = (each for each in others if not each.wait.block.suspends)
    holder = next((each.doer for each in holding if isinstance(each.doer, Callback)), None)
    if served and holder is not None and is_one_thread(context.unit.executor):
        on_it = stuck.doer if isinstance(stuck.doer, Callback) else holder
        keeps = f'{called(on_it)} holds the only thread of the executor'
        return f'{_names(served)} cannot run: {keeps}'
    shut = _shut_out_of(enders, others, context)
    if shut:
        return listing(_shut_out(ender, others, context) for ender in shut)
    if served and _is_full(others, context):
        return f'no thread is left to run {_names(enders)}: {_number(context)}, and each waits'
    late = [each for each in enders if isinstance(each, Activity) and _follows(each)]
    if len(late) == len(enders):
        starters = dict.fromkeys(start.by for each in late for start in each.starts)
        return f'{_names(late)} begins only when {listing(starters)} has ended, on one thread'
    if is_given_once(stuck, context):
        return f'{_names(enders)} runs only once, and an earlier wait uses up what it does for it'
    early = 'comes too early, or another wait uses it up'
    if stuck.wait.block.needs is not Needs.EACH:
        early = 'is not sure to come'
    return f'what {_names(enders)} does for it {early}'


def is_given_once(stuck: Stuck, context: Context) -> bool:
    """Whether each wait uses up what only callbacks do that run once."""
    enders = [context.by_name.get(name) for name in stuck.enders]
    is_each = stuck.wait.block.needs is Needs.EACH and not stuck.wait.block.forgets
    return is_each and all(ender is not None and ender.one_shot for ender in enders)


def is_for_itself(stuck: Stuck) -> bool:
    """Whether a coroutine awaits what only another run of it could do."""
    return stuck.wait.block.suspends and stuck.enders == (stuck.doer.name,)


def shut_out_for(stuck: Stuck, others: Sequence[Stuck], context: Context) -> list[str]:
    """What could end a wait but is kept from it by a closed group, by display name."""
    enders = [context.doer_by_name[name] for name in stuck.enders if name in context.doer_by_name]
    return [ender.display_name for ender in _shut_out_of(enders, others, context)]


def _shut_out_of(
    enders: Sequence[Doer], others: Sequence[Stuck], context: Context
) -> list[Callback]:
    served = (ender for ender in enders if isinstance(ender, Callback))
    shut = [ender for ender in served if _keeper(ender, others, context) is not None]
    is_all = len(shut) == len(enders) or any(is_client(ender) for ender in shut)
    return shut if is_all else []


def _follows(thread: Activity) -> bool:
    """Whether it begins when the code that starts it has ended."""
    return bool(thread.starts) and all(start.after is None for start in thread.starts)


def _why_nobody(stuck: Stuck, context: Context) -> str:
    names = dict.fromkeys(waker.by for waker in stuck.wait.block.wakers)
    late = [context.by_name[name] for name in names if name in context.by_name]
    if late and all(client_before(each, context.unit.callbacks) == stuck.doer for each in late):
        client = context.by_name[stuck.doer.name]
        return (
            f'{_names(late)}, which ends it, comes with an answer that the same client takes, and '
            f'{context.group_of(client).display_name} is closed meanwhile'
        )
    return 'nothing ends that wait'


def _names(doers: Sequence[Doer]) -> str:
    return listing(map(called, doers))


def _waits_too(stuck: Stuck) -> str:
    what = f' for {stuck.what}' if stuck.what else ''
    return f'{called(stuck.doer)}, which ends it, itself waits{what}'


def _keeper(ender: Callback, others: Sequence[Stuck], context: Context) -> Callback | None:
    """What keeps the group of ``ender`` closed while it waits."""
    group = context.exclusive_group(ender)
    keepers = (each.doer for each in others if isinstance(each.doer, Callback))
    return next((k for k in keepers if group is not None and k.group == group.name), None)


def _shut_out(ender: Callback, others: Sequence[Stuck], context: Context) -> str:
    keeper = _keeper(ender, others, context)
    assert keeper is not None, 'asked of those that are shut out'
    return (
        f'{ender.display_name} is in {context.group_of(ender).display_name}, which is closed '
        f'while {keeper.display_name} waits'
    )


def _number(context: Context) -> str:
    """How many threads there are, and where that depends on the machine."""
    count, workers = len(context.unit.executor.threads), workers_of(context.unit.executor)
    if isinstance(workers, Workers) and workers.is_default:
        return f'{plural(count, "thread")} on a machine with {count} CPUs'
    return f'{plural(count, "thread")} in all'


def _is_full(others: Sequence[Stuck], context: Context) -> bool:
    held = {each.standstill.thread for each in others if not each.standstill.spins}
    return held >= set(context.unit.executor.threads)
