"""
CC115: a lock is held over a wait that only ends when another doer has got that lock.

What concerns tasks of an asyncio loop is found by the extractor.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, plural, shown
from ros2cc_extract.findings.waits.verdicts import (
    PROGRESS,
    is_of_repeated,
    refuting_run,
    rests_on_absent_service,
    shown_hang,
)
from ros2cc_extract.findings.waits.waits import Wait, WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import is_one_thread, workers_of
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import RE_ENTRANT, Act
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Evidence

_SPINS = (WaitKind.SPIN, WaitKind.SPUN_FUTURE)


def find(context: Context) -> Iterator[Hit]:
    """One finding per callback and lock; only where the model knows a run that ends so."""
    unit = context.unit
    if unit.unresolved or isinstance(workers_of(unit.executor), Unknown):
        return
    reported: set[tuple[str, str]] = set()
    for wait in waits_of(context):
        for lock in _held(wait):
            key = (wait.caller.name, lock)
            stuck = {} if key in reported else dict(_stuck(wait.caller, lock, context))
            if stuck:
                reported.add(key)
                yield _hit(wait, lock, stuck, context)


def _held(wait: Wait) -> Iterator[str]:
    """The locks that are held over a wait that others must end; a time-out ends all but a spin."""
    others_end_it = bool(wait.needs) or wait.kind is WaitKind.PRESENCE
    if wait.kind in _SPINS or (others_end_it and not wait.has_timeout):
        yield from (lock.removesuffix(RE_ENTRANT) for lock in wait.block.held)


def _stuck(caller: Callback, lock: str, context: Context) -> Iterator[tuple[str, Act]]:
    """The callbacks that take the lock and are known to wait for it forever, by name."""
    for other in context.written:
        if other.node == caller.node and _waits_for_ever(other, caller, context):
            for act in other.locks:
                if act.name == lock and not act.tries:
                    yield other.name, act
                    break


def _waits_for_ever(other: Callback, holder: Callback, context: Context) -> bool:
    run = refuting_run(PROGRESS, context, other)
    if run is None or rests_on_absent_service(run):
        return False
    last = _last_event_of(other, run)
    return last is not None and last.is_for_lock and last.needed == holder.name


def _last_event_of(callback: Callback, run: Evidence) -> Event | None:
    events = (event for moment in reversed(run.moments) for event in reversed(moment.events))
    return next((event for event in events if event.who == callback.name), None)


def _hit(wait: Wait, lock: str, stuck: dict[str, Act], context: Context) -> Hit:
    caller = wait.caller
    others = [context.by_name[name] for name in stuck]
    again = others == [caller]
    who = 'another run of it' if again else shown(others)
    # With one run at a time none is stuck: the rates decide whether so many come together.
    rests_on_rates = any(is_of_repeated(other, context) for other in others)
    how_many = 'all' if rests_on_rates else 'both'
    one_thread = is_one_thread(context.unit.executor)
    if rests_on_rates and not one_thread:
        who = f'runs on all {plural(len(context.unit.executor.threads), "thread")}'
    return Hit(
        place=wait.place,
        message=f'{caller.display_name} holds {lock} while it waits in {wait.block.call}, and '
        f'{who} may wait for {lock} meanwhile: then {how_many} wait forever',
        help=f'give {lock} back before the wait, and take it again afterwards',
        severity=_severity_by_rates(one_thread) if rests_on_rates else None,
        subjects=(caller.name, lock),
        chain=wait.chain,
        related=(
            *(
                Remark(_place(act, context.by_name[name]), f'{lock} is taken here')
                for name, act in stuck.items()
            ),
            *made_at(caller, *(other for other in others if other != caller)),
        ),
        run=shown_hang(others[0], {caller.name, *stuck}, context),
    )


def _severity_by_rates(one_thread: bool) -> Severity:
    return Severity.WARNING if one_thread else Severity.NOTE


def _place(act: Act, callback: Callback) -> Place:
    return act.source or callback.defined or callback.source or Place(callback.name)


RULE = Rule(
    code='CC115',
    slug='lock-over-wait',
    severity=Severity.ERROR,
    title='Lock held over a wait that others must end',
    what='A callback waits for others while it holds a lock: in a synchronous call, for an '
    'event, at an `await` or in a nested spin. A callback that must run first, or that runs '
    'inside the spin, takes the same lock. Neither can continue. The same holds for a task of an '
    'asyncio loop that keeps a `threading.Lock` over an `await`, while another task of that loop, '
    'another run of the same one, or a callback that the loop spins takes it.',
    why='A callback that waits for a lock keeps its thread and its mutually exclusive group. In '
    'a nested spin of a single-threaded executor it even sits on the stack above the callback '
    'that holds the lock. If the deadlock needs several runs of one reentrant callback at the '
    'same time, it is a warning on one thread, and a note where they must fill a pool. The model '
    'of profile `rclpy` decides, and the run is shown. Semaphores, your own lock classes and '
    'locks that are only tried are not checked; an `RLock` is checked where another thread waits '
    'for it. All tasks of an asyncio loop have one thread, so one that waits for a lock holds up '
    'the task that has it (an error for two known tasks, a warning where one must run several '
    'times at once). Sources: Python, `threading`, `asyncio/events.py`; rclpy 7.1.6 and 9.1.2, '
    '`executors.py`, `client.py`.',
    bad="""\
class Planner(Node):
    def replan(self):                       # a timer
        with self.lock:
            future = self.client.call_async(Plan.Request())
            self.executor.spin_until_future_complete(future)

    def on_goal(self, message):             # in another group: runs inside the spin
        with self.lock:
            self.goal = message
""",
    good="""\
class Planner(Node):
    def replan(self):
        self.client.call_async(Plan.Request()).add_done_callback(self.on_plan)

    def on_goal(self, message):
        with self.lock:
            self.goal = message
""",
    mend='Keep a lock for a few statements only, and never while you wait. Without a lock the '
    'callbacks of one mutually exclusive group are kept apart as well.',
    find=find,
)
