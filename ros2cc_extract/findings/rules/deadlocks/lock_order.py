"""CC111: locks that are waited for while others are held, in an order that can close a circle."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Doer, Hit, Rule
from ros2cc_extract.findings.base.wording import called, made_at
from ros2cc_extract.findings.waits.concurrent_threads import beside, node_of, repeats_freely
from ros2cc_extract.findings.waits.overlap import overlap, overlaps_itself
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.model import Activity
from ros2cc_extract.spec.program_order import steps as way_of
from ros2cc_extract.verify.results.evidence import Evidence


@dataclass(frozen=True)
class Step:
    """A callback or a thread takes ``wanted`` while it holds ``held``."""

    doer: Doer
    act: Act
    held: str
    wanted: str

    @property
    def place(self) -> Place:
        """Where the second lock is taken."""
        doer = self.doer
        return self.act.source or doer.defined or doer.source or Place(doer.name)

    @property
    def chain(self) -> tuple[Remark, ...]:
        """The calls that lead there."""
        return tuple(Remark(at, 'called from here') for at in self.act.chain)


def find(context: Context) -> Iterator[Hit]:
    """One finding per lock taken twice, and per pair of locks and of those that take them."""
    steps = list(_steps(context))
    reported: set[tuple[str, str]] = set()
    for step in steps:
        if step.held == step.wanted and (step.doer.name, step.held) not in reported:
            reported.add((step.doer.name, step.held))
            yield _taken_twice(step)
    crossed: set[frozenset[str]] = set()
    for one, other in _pairs(steps):
        key = frozenset((one.held, one.wanted, one.doer.name, other.doer.name))
        if key in crossed or not _may_meet(one, other, context):
            continue
        together = _coincide(one, other, context)
        if together is not None:
            crossed.add(key)
            yield _crossed(one, other, together.run)


def _steps(context: Context) -> Iterator[Step]:
    for doer in context.doers:
        for act in doer.locks:
            if isinstance(act.name, str):
                for held in act.held:
                    yield Step(doer, act, held, act.name)


def _pairs(steps: list[Step]) -> Iterator[tuple[Step, Step]]:
    for one, other in combinations(steps, 2):
        if one.held != one.wanted and (one.held, one.wanted) == (other.wanted, other.held):
            yield one, other


def _may_meet(one: Step, other: Step, context: Context) -> bool:
    """
    Nodes are known, and there is no third lock that both hold.

    A name stands for one lock in the whole unit, so that two nodes cross as one does.
    """
    is_known = all(node_of(step.doer, context) is not None for step in (one, other))
    return is_known and not set(one.act.held) & set(other.act.held)


@dataclass(frozen=True)
class _Together:
    run: Evidence | None = None


def _coincide(one: Step, other: Step, context: Context) -> _Together | None:
    first, second = one.doer, other.doer
    if isinstance(first, Activity) or isinstance(second, Activity):
        if isinstance(first, Activity) and first == second:
            return _Together() if repeats_freely(first, context) else None
        return _Together() if beside(first, second, context) is not None else None
    if first == second:
        return _Together() if overlaps_itself(first, context) else None
    found = overlap(first, second, context)
    return _Together(found.run) if found is not None else None


def _taken_twice(step: Step) -> Hit:
    name = called(step.doer)
    return Hit(
        place=step.place,
        message=f'{name} takes {step.wanted} while it holds it: its holder waits for a '
        'threading.Lock too, forever',
        help='use a threading.RLock, or take the lock in one of the two functions only',
        subjects=(step.doer.name, step.held),
        chain=step.chain,
        related=_where_held(step),
    )


def _where_held(step: Step) -> tuple[Remark, ...]:
    """The last place where the lock was taken before, in a function that goes on; the callback."""
    takings = [
        act for act in step.doer.locks if act.name == step.held and act.source and act != step.act
    ]
    around = [act for act in takings if _goes_on_around(act, step.act)] or takings[:1]
    last = max(around, key=way_of, default=None)
    first = (Remark(last.source, f'{step.held} is taken here'),) if last and last.source else ()
    return (*first, *made_at(step.doer))


def _goes_on_around(outer: Act, inner: Act) -> bool:
    """Whether the function that does the one still runs when the other is done."""
    return outer.chain == inner.chain[: len(outer.chain)] and way_of(outer) < way_of(inner)


def _crossed(one: Step, other: Step, run: Evidence | None) -> Hit:
    first, second = called(one.doer), called(other.doer)
    whom = 'a second run of it' if one.doer == other.doer else second
    return Hit(
        place=one.place,
        message=f'{first} holds {one.held} and waits for {one.wanted}, and {whom} may hold '
        f'{other.held} and wait for {other.wanted} at the same time: both wait forever',
        help='take the two locks in the same order everywhere, or use one lock',
        subjects=(one.doer.name, other.doer.name, one.held, one.wanted),
        chain=one.chain,
        related=(
            Remark(other.place, f'{second} takes {other.wanted} here, holding {other.held}'),
            *made_at(one.doer, other.doer),
        ),
        run=run,
    )


RULE = Rule(
    code='CC111',
    slug='lock-order',
    severity=Severity.ERROR,
    title='Locks taken in opposite order',
    what='Two callbacks, or a callback and a thread, that may run at the same time take two '
    'locks in opposite order; or one takes a `threading.Lock` that it already holds. Each waits '
    'for the other forever and keeps its thread and group. Or a handler of a signal takes a '
    '`threading.Lock` that the main thread, which it interrupts, may hold: in `main`, or in a '
    'callback that the main thread runs itself. Or it uses a `queue.Queue`, which has such a '
    'lock inside, that a callback in the main thread uses too (a warning: it is held shortly).',
    why='A `threading.Lock` has no owner: its holder waits for it like everybody else. The model '
    'decides whether two callbacks may overlap; if the unit was not verified, their groups and '
    'the number of threads do. Locks taken with a time-out, read locks, and cycles of three '
    'locks are not checked, nor handlers that a second signal interrupts. Sources: Python, '
    '`threading`, `signal` (handlers run in the main thread, which goes on behind them); rclpy '
    '7.1.6 and 9.1.2, `executors.py` '
    '(`MultiThreadedExecutor` runs callbacks in other threads). Measured on 7.1.6: both callbacks '
    'stop within a second, and so does a callback that a handler interrupts.',
    bad="""\
class Arm(Node):
    def on_move(self, msg):            # on_move and on_stop in different groups
        with self.plan_lock:
            with self.motor_lock:
                self.motor.move(self.plan)

    def on_stop(self, msg):
        with self.motor_lock:
            with self.plan_lock:
                self.plan = None
""",
    good="""\
class Arm(Node):
    def on_move(self, msg):
        with self.plan_lock, self.motor_lock:
            self.motor.move(self.plan)

    def on_stop(self, msg):
        with self.plan_lock, self.motor_lock:
            self.plan = None
""",
    mend='Take locks in the same order everywhere; use a `threading.RLock` where a function that '
    'holds a lock calls another one that takes it.',
    find=find,
)
