"""CC120 and CC121: waits whose end the model does not know, and waits that others outside end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Doer, Hit, Rule
from ros2cc_extract.findings.base.wording import listing, plural, shown
from ros2cc_extract.findings.rules.deadlocks.never_ends import open_facts, unexplained
from ros2cc_extract.findings.waits.exhausted_permits import is_used_up
from ros2cc_extract.findings.waits.stuck_callbacks import stuck_in
from ros2cc_extract.findings.waits.uncalled_waits import is_uncalled, uncalled_hits
from ros2cc_extract.findings.waits.verdicts import PROGRESS, refuting_run, surely_ends, verdict_on
from ros2cc_extract.findings.waits.waits import (
    AnyWait,
    WaitKind,
    are_one,
    at_one_place,
    callers_of,
    how_long,
    kind_of,
    waits_in,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import (
    ENDLESS_LOOP,
    NOT_FOLLOWED,
    OUTSIDE,
    TIME,
    UNKNOWN_WAIT,
    WORKING_LOOP,
    Blocking,
)
from ros2cc_extract.spec.late_spins import late_spins
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback
from ros2cc_extract.spec.releases.table import UNTIL_ASKS_FUTURE
from ros2cc_extract.verify.results.caveats import OpenEnd, open_ends
from ros2cc_extract.verify.results.results import Verdict

CODE = 'CC120'
_TO_THE_END = frozenset({'Thread.join', 'polling loop'})
_FOREIGN = frozenset({'await', UNKNOWN_WAIT, NOT_FOLLOWED})
_SPINS = (WaitKind.SPIN, WaitKind.SPUN_FUTURE)
_LISTENING = ('recv', 'read', 'accept', 'input')
_UNKNOWN_END = 'it is not known what ends it'
_WAKES_NOBODY = (
    'a thread may be the one that ends it, which wakes no executor: it goes on once something '
    'else does so'
)

_ENDS_LATE = (
    'a thread may be the one that completes the future: before rclpy 5.0.1 (Humble) the spin ends '
    'only once a callback is served after that'
)


def find_undecided(context: Context) -> Iterator[Hit]:
    """One line for each wait, however many callbacks it may hold up."""
    yield from _hits(context, is_outside=False)


def find_outside(context: Context) -> Iterator[Hit]:
    """What ends by another process or the operating system, if it ends."""
    yield from _hits(context, is_outside=True)


def _hits(context: Context, *, is_outside: bool) -> Iterator[Hit]:
    reasons: dict[int, str] = {}
    waits: list[AnyWait] = []
    ends = open_ends(context.unit)
    for caller in context.doers:
        for block, reason in _open(caller.blocking, ends[caller.name]):
            wait = AnyWait(caller, block, kind_of(block))
            is_settled = not is_outside and surely_ends(wait, context)
            is_none = is_settled or block.call == WORKING_LOOP or _is_for_spinning(wait, context)
            is_none = is_none or is_used_up(block, caller, context)
            is_none = is_none or _holds_nobody_up(wait, context) or _only_listens(wait, context)
            if _ends_outside(block) is is_outside and not is_none:
                waits.append(wait)
                reasons[id(wait)] = reason
    if not is_outside:
        yield from _of_limits(tuple(_cut_short(context, waits)), context)
        for wait in _unwoken(context):
            waits.append(wait)
            reasons[id(wait)] = _WAKES_NOBODY
        for wait in _not_proven(context):
            waits.append(wait)
            reasons[id(wait)] = open_facts(context)
        set_up = list(_of_set_up(context))
        yield from uncalled_hits(filter(is_uncalled, set_up), _set_up(context).name)
        for wait in (each for each in set_up if not is_uncalled(each)):
            waits.append(wait)
            reasons[id(wait)] = _reason(wait.block)
        for wait in _late(context):
            waits.append(wait)
            reasons[id(wait)] = _ENDS_LATE
    else:
        for wait in _for_messages(context, ends):
            waits.append(wait)
            reasons[id(wait)] = ''
    spins = [] if is_outside else [wait for wait in waits if wait.kind in _SPINS]
    waits = [wait for wait in waits if wait not in spins]
    for reason in dict.fromkeys(reasons[id(wait)] for wait in spins):
        alike = [wait for wait in spins if reasons[id(wait)] == reason]
        yield _of_one_cause(alike, reason, context)
    cut = [wait for wait in waits if wait.block.call == NOT_FOLLOWED]
    for reason in dict.fromkeys(_why(wait.block) for wait in cut):
        yield _of_cut([wait for wait in cut if _why(wait.block) == reason], reason)
    for at_one in at_one_place(wait for wait in waits if wait.block.call != NOT_FOLLOWED):
        yield _hit(at_one, reasons[id(at_one[0])], context, is_outside=is_outside)


def _of_cut(waits: Sequence[AnyWait], why: str) -> Hit:
    """One line for all that was not followed for one reason."""
    return Hit(
        place=waits[0].place,
        message=f'not decided: {shown(wait.caller for wait in waits)} may wait in {NOT_FOLLOWED}: '
        f'{why}',
        help='check the program alone, or with a higher limit',
        subjects=callers_of(waits),
        cause=NOT_FOLLOWED,
    )


def _of_limits(waits: Sequence[AnyWait], context: Context) -> Iterator[Hit]:
    """One line for all waits of a callback about which one limit leaves the question open."""
    of_callers: dict[tuple[str, str], list[AnyWait]] = {}
    for wait in waits:
        of_callers.setdefault((wait.caller.name, _limit_of(wait, context)), []).append(wait)
    alike: dict[object, tuple[str, list[AnyWait]]] = {}
    for (_, reason), own in of_callers.items():
        ways = tuple(dict.fromkeys((wait.place, wait.block.call) for wait in own))
        alike.setdefault((reason, ways), (reason, []))[1].extend(own)
    for reason, together in alike.values():
        yield _of_one_cause(together, reason, context)


def _of_one_cause(waits: Sequence[AnyWait], reason: str, context: Context) -> Hit:
    first = waits[0]
    others: dict[Place, list[AnyWait]] = {}
    for wait in waits:
        others.setdefault(wait.place, []).append(wait)
    here = others.pop(first.place)
    more = f' and in {plural(len(others), "more place")}' if others else ''
    there = f'{who_waits(waits)} in {waits_in(first)}{_named(first)}{more}'
    return replace(
        _hit(here, reason, context, is_outside=False),
        message=f'not decided: {there}, and {reason}',
        subjects=callers_of(waits),
        related=tuple(
            Remark(place, f'{who_waits(alike)} here in {waits_in(alike[0])}')
            for place, alike in others.items()
        ),
    )


def _named(wait: AnyWait) -> str:
    what = wait.block.resource or (wait.block.on if isinstance(wait.block.on, str) else None)
    return f' for {what}' if what else ''


def _for_messages(context: Context, ends: Mapping[str, Sequence[OpenEnd]]) -> Iterator[AnyWait]:
    """
    Waits for messages from another process: answers, and what nothing here can send meanwhile.

    No error shows a lost message, or a missing listener. If the model refutes the wait
    anyhow, or doubts its end for another reason, that is reported.
    """
    for caller in context.doers:
        if refuting_run(PROGRESS, context, caller) is None:
            is_told = _is_in_doubt(caller, ends[caller.name], context)
            for block in caller.blocking:
                is_for_one = block.answer_to is not None or block.unsent is not None
                is_open = block.escapes is not None or (is_told and block.seconds is None)
                if is_for_one and not is_open:  # else it is reported as undecided
                    yield AnyWait(caller, block, kind_of(block))


def _is_in_doubt(caller: Doer, ends: Sequence[OpenEnd], context: Context) -> bool:
    """Whether each wait of ``caller`` that has no time-out is reported, for one doubt."""
    result = verdict_on(PROGRESS, context, caller)
    is_undecided = result is not None and result.verdict is Verdict.UNDECIDED and result.in_doubt
    return is_undecided and all(_ends_outside(end.block) for end in ends)


def _open(blocking: Sequence[Blocking], ends: Sequence[OpenEnd]) -> Iterator[tuple[Blocking, str]]:
    for block in blocking:
        end = next((end for end in ends if block is end.block), None)
        if end is not None:
            yield block, end.why or _reason(block)


def _reason(block: Blocking) -> str:
    why = _why(block)
    return f'{_UNKNOWN_END}: {why}' if why else _UNKNOWN_END


def _why(block: Blocking) -> str:
    if block.escapes is not None:
        return block.escapes.reason
    return block.on.reason if isinstance(block.on, Unknown) else ''


def _call_and_reason(wait: AnyWait, reason: str) -> tuple[str, str]:
    """Where it waits, and why that is open: the reason of an unknown call begins with the call."""
    if wait.block.call == ENDLESS_LOOP:
        return 'a loop without end', _why(wait.block)
    call, colon, why = _why(wait.block).partition(': ')
    if wait.block.call != UNKNOWN_WAIT or not colon or not reason.endswith(why):
        return waits_in(wait), reason
    return call, f'{reason.removesuffix(f"{call}: {why}")}{why}'


def _ends_outside(block: Blocking) -> bool:
    wakers = {waker.by for waker in block.wakers}
    return block.escapes is None and OUTSIDE in wakers and block.unread is None


def _is_for_spinning(wait: AnyWait, context: Context) -> bool:
    """
    A thread that waits for the end of one that spins lives as long as the program.

    So does one that goes round until a signal comes, or until the program ends; and the main
    program, where no other thread needs it, waits until other code wants it to go on or to end.
    """
    caller = wait.caller
    is_main = isinstance(caller, Callback) and caller.is_main
    if isinstance(caller, Activity):
        is_main = caller.kind is ActivityKind.MAIN
    elif not is_main:
        return False
    if wait.block.answer_to is not None or not _ends_outside(wait.block):
        return False
    return wait.block.call in _TO_THE_END or (is_main and not _is_needed(wait, context))


def _holds_nobody_up(wait: AnyWait, context: Context) -> bool:
    """
    Whether a thread waits in code that is not followed, and nothing needs it to go on.

    A server on a loop of its own does nothing else.
    """
    is_thread = _is_foreign(wait.block) and isinstance(wait.caller, Activity)
    return is_thread and not _is_needed(wait, context)


def _only_listens(wait: AnyWait, context: Context) -> bool:
    """
    Whether a daemon thread waits for the next word from outside, or for a child, and no more.

    That is its work: nothing needs it to go on, and the program ends without it.
    """
    thread = wait.caller
    if not isinstance(thread, Activity) or not thread.daemon or not _ends_outside(wait.block):
        return False
    last = wait.block.call.rpartition('.')[2]
    listens = thread.loops and last.startswith(_LISTENING)
    return (listens or wait.block.call == 'Popen.wait') and not _is_needed(wait, context)


def _is_needed(wait: AnyWait, context: Context) -> bool:
    """Whether others wait for its caller, for what that signals, or for a lock that it holds."""
    name = wait.caller.name
    others = (each for doer in context.doers if doer.name != name for each in doer.blocking)
    is_waker = any(waker.by == name for each in others for waker in each.wakers)
    return bool(wait.block.held) or is_waker


def _is_foreign(block: Blocking) -> bool:
    return isinstance(block.on, Unknown) and block.call in _FOREIGN


def _cut_short(context: Context, reported: Sequence[AnyWait]) -> Iterator[AnyWait]:
    """
    Waits of callbacks whose ends are undecided because of a limit of the checker.

    Or that end only by what is not known to come; where a wait is reported already, claims about
    ends may be open for its reason.
    """
    callers = {wait.caller.name for wait in reported}
    for caller in context.doers:
        result = verdict_on(PROGRESS, context, caller)
        if result is None or result.verdict is not Verdict.UNDECIDED or caller.name in callers:
            continue
        if result.in_doubt or not reported:
            yield from (
                AnyWait(caller, block, kind_of(block))
                for block in caller.blocking
                if kind_of(block) is not WaitKind.SLEEP
                and block.seconds is None
                and block.call != WORKING_LOOP
            )


def _unwoken(context: Context) -> Iterator[AnyWait]:
    """
    Awaits that a thread ends, and that last forever in the model, which knows no other wake-up.

    The specification does not say whether code calls ``wake``, or something else comes.
    """
    for caller in context.written:
        run = refuting_run(PROGRESS, context, caller)
        if run is None or caller.name in {stuck.doer.name for stuck in stuck_in(run, context)}:
            continue
        for block in caller.blocking:
            if _is_by_thread(block):
                yield AnyWait(caller, block, kind_of(block))


def _is_by_thread(block: Blocking) -> bool:
    return block.call == 'await' and block.foreign and block.seconds is None


def _not_proven(context: Context) -> Iterator[AnyWait]:
    """Waits that last forever in the model of a unit with unknown facts."""
    if open_facts(context):
        yield from (stuck.wait for together, _ in unexplained(context) for stuck in together)


def _of_set_up(context: Context) -> Iterator[AnyWait]:
    """
    Waits of code that no callback runs; what others outside end there is taken to end.

    An await of a library's coroutine holds up only its own coroutine, under any name.
    """
    caller = _set_up(context)
    foreign = [block for block in context.unit.set_up if _is_foreign(block)]
    awaits = {_line_of(block) for block in foreign if block.call == 'await'}
    for block in context.unit.set_up:
        is_awaited = _is_foreign(block) and _line_of(block) in awaits
        if block.escapes is not None and block.seconds is None and not is_awaited:
            yield AnyWait(caller, block, kind_of(block))


def _set_up(context: Context) -> Activity:
    name = 'main' if context.unit.entry is not None else 'the set-up'
    return Activity(name=name, kind=ActivityKind.MAIN)


def _late(context: Context) -> Iterator[AnyWait]:
    """Spins until a future that do not end when it is done."""
    if UNTIL_ASKS_FUTURE.holds(context.unit.rclpy) is not True:
        for block in late_spins(context.unit):
            yield AnyWait(_set_up(context), block, kind_of(block))


def _line_of(block: Blocking) -> object:
    return (block.source.file, block.source.line) if block.source is not None else None


def _limit_of(wait: AnyWait, context: Context) -> str:
    result = verdict_on(PROGRESS, context, wait.caller)
    return (result.reason if result else None) or 'a limit was hit'


def _senders(topics: str, context: Context) -> Iterator[Callback | Activity]:
    """What publishes them here."""
    for doer in context.doers:
        names = (act.name for act in doer.publishes if isinstance(act.name, str))
        if any(name.strip('/') in topics.split(', ') for name in names):
            yield doer


def _hit(waits: Sequence[AnyWait], reason: str, context: Context, *, is_outside: bool) -> Hit:
    wait = waits[0]
    call, reason = _call_and_reason(wait, reason)
    verb = 'waits' if are_one(waits) else 'wait'
    start = f'{who_waits(waits)} in {call}{_named(wait)}'
    ends = f'and {verb} forever unless {_others(wait)} ends it'
    if wait.block.recursive:
        ends = f'and unless {_others(wait)} ends it, {how_long(wait)}'
    if wait.block.answer_to is not None and is_outside:
        topic = wait.block.answer_to
        ends = (
            f'and {verb} forever unless another program answers the message on {topic}, or if '
            'one of the two is lost'
        )
    elif wait.block.unsent is not None and is_outside:
        topic = wait.block.unsent
        ends = (
            f'and {verb} forever unless another program publishes {topic}, as '
            f'{shown(_senders(topic, context))} cannot do so meanwhile'
        )
    return Hit(
        place=wait.place,
        message=f'{start} without a time-out, {ends}'
        if is_outside
        else f'not decided: {start}, and {reason}',
        help=_help(wait, is_outside=is_outside),
        subjects=callers_of(waits),
        chain=wait.chain,
        related=tuple(ways_of_others(waits)),
        cause=waits_in(wait),
    )


def _help(wait: AnyWait, *, is_outside: bool) -> str:
    """A loop has no time-out; code that waits in a thread of its own is in one already."""
    if is_outside:
        own = '' if isinstance(wait.caller, Activity) else ', or do it in a thread of its own'
        return f'give it a time-out{own}'
    if _is_by_thread(wait.block):
        return 'call wake() of the executor after that, or let a callback end it'
    if wait.block.call == ENDLESS_LOOP:
        return 'let a timer do the work of the loop'
    return 'give it a time-out, or end it in code that the scanner can follow'


def _others(wait: AnyWait) -> str:
    """
    What the unit does not show, with what ends it too in the unit.

    That may be another executor of the same program: units are judged one by one.
    """
    inside = [waker.by for waker in wait.block.wakers if waker.by not in (OUTSIDE, TIME)]
    others = 'else' if isinstance(wait.caller, Activity) else 'outside its executor'
    return ' or '.join([*([listing(inside)] if inside else []), f'something {others}'])


UNDECIDED = Rule(
    code=CODE,
    slug='undecided-wait',
    severity=Severity.NOTE,
    title='Wait that could not be decided',
    what='A callback, `main` or a thread waits for something, and the code that ends the wait '
    'could not be followed: the object was passed to unknown code, or no known code ends the '
    'wait. The same holds for an await of something that a thread completes: that '
    'wakes no executor, and it is unknown when something else does; on Humble, of a spin until '
    'a future that a thread completes. Whether the wait ends is '
    'open, and so is every claim that depends on it. There is one line for each wait, not for '
    'each callback that it may block. With `--strict` the exit status is 3.',
    why='A callback keeps its thread while it waits, and its mutually exclusive group. A clean '
    'result means that no wait lasts forever; this note says where that is not known. Sources: '
    'rclpy 7.1.6 and 9.1.2, `executors.py` (`_make_handler`), `callback_groups.py`.',
    bad="""\
class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.jobs = connect_to_plant()           # a library whose source is not available
        self.create_timer(0.5, self.feed)

    def feed(self):
        self.jobs.wait()
""",
    good="""\
class Feeder(Node):
    def feed(self):
        self.jobs.wait(timeout=0.1)
""",
    mend='Give the wait a time-out. Or let a known callback or thread end it, so that the '
    'model can decide it.',
    find=find_undecided,
)

OUTSIDE_WAIT = Rule(
    code='CC121',
    slug='outside-wait',
    severity=Severity.NOTE,
    title='Wait that nothing on its executor ends',
    what='A callback, `main` or a thread waits without a time-out for something outside: a '
    'process, a socket, a serial port or a person; another executor or program; the answer of '
    'another program to a message that was published before; or a message that nothing in this '
    'program publishes during the wait, because its publishers are in the same group. '
    'Commands that end at once, as `pkill` and `mkdir`, are no waits; a daemon thread that '
    'reads in a loop, and for which nobody waits, is not reported. The verdicts assume that '
    'the wait ends. If it does not, a callback keeps its thread and its '
    'mutually exclusive group forever, and a thread keeps the process alive.',
    why='Nothing on this executor ends such a wait: without a time-out it lasts until the other '
    'side acts. Sources: Python 3.11, library reference, `subprocess`, `socket`, `input`; '
    'rclpy 7.1.6 and 9.1.2, `executors.py`: a callback holds its thread and its group until it '
    'returns.',
    bad="""\
class Feeder(Node):
    def feed(self):
        subprocess.run(['plant', 'feed'])
""",
    good="""\
class Feeder(Node):
    def feed(self):
        subprocess.run(['plant', 'feed'], timeout=1.0)
""",
    mend='Give the wait a time-out, or do it in a thread of its own.',
    find=find_outside,
)
