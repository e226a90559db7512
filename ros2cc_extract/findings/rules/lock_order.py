"""CC111: locks that are waited for while others are held, in an order that can close a circle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.model import Remark
from ros2cc_extract.findings.overlap import overlap, overlaps_itself
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.words import made_at
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import Act
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.verify.evidence import Evidence


@dataclass(frozen=True)
class Step:
    """A callback takes ``wanted`` while it holds ``held``."""

    callback: Callback
    act: Act
    held: str
    wanted: str

    @property
    def place(self) -> Place:
        """Where the second lock is taken."""
        callback = self.callback
        return self.act.source or callback.defined or callback.source or Place(callback.name)

    @property
    def chain(self) -> tuple[Remark, ...]:
        """The calls that lead there."""
        return tuple(Remark(at, 'called from here') for at in self.act.chain)


def find(context: Context) -> Iterator[Hit]:
    """One finding per lock taken twice, and per pair of locks and callbacks."""
    steps = list(_steps(context))
    told: set[tuple[str, str]] = set()
    for step in steps:
        if step.held == step.wanted and (step.callback.name, step.held) not in told:
            told.add((step.callback.name, step.held))
            yield _taken_twice(step)
    crossed: set[frozenset[str]] = set()
    for one, other in _pairs(steps):
        key = frozenset((one.held, one.wanted, one.callback.name, other.callback.name))
        if key in crossed or not _may_meet(one, other):
            continue
        together = _coincide(one, other, context)
        if together is not None:
            crossed.add(key)
            yield _crossed(one, other, together.run)


def _steps(context: Context) -> Iterator[Step]:
    for callback in context.written:
        for act in callback.locks:
            if isinstance(act.name, str):
                for held in act.held:
                    yield Step(callback, act, held, act.name)


def _pairs(steps: list[Step]) -> Iterator[tuple[Step, Step]]:
    for one, other in combinations(steps, 2):
        if one.held != one.wanted and (one.held, one.wanted) == (other.wanted, other.held):
            yield one, other


def _may_meet(one: Step, other: Step) -> bool:
    """Locks of one node, and no third lock that both hold."""
    same_node = isinstance(one.callback.node, str) and one.callback.node == other.callback.node
    return same_node and not set(one.act.held) & set(other.act.held)


@dataclass(frozen=True)
class _Together:
    run: Evidence | None = None


def _coincide(one: Step, other: Step, context: Context) -> _Together | None:
    if one.callback == other.callback:
        return _Together() if overlaps_itself(one.callback, context) else None
    found = overlap(one.callback, other.callback, context)
    return _Together(found.run) if found is not None else None


def _taken_twice(step: Step) -> Hit:
    name = step.callback.display_name
    return Hit(
        place=step.place,
        message=f'{name} takes {step.wanted} while it holds it: a threading.Lock waits for its '
        'own holder, for ever',
        help='use a threading.RLock, or take the lock in one of the two functions only',
        subjects=(step.callback.name, step.held),
        chain=step.chain,
        related=_where_held(step),
    )


def _where_held(step: Step) -> tuple[Remark, ...]:
    """The place where the lock was taken before, and the callback."""
    before = [
        act.source
        for act in step.callback.locks
        if act.name == step.held and act.source and act != step.act
    ]
    first = (Remark(before[0], f'{step.held} is taken here'),) if before else ()
    return (*first, *made_at(step.callback))


def _crossed(one: Step, other: Step, run: Evidence | None) -> Hit:
    first, second = one.callback.display_name, other.callback.display_name
    whom = 'a second run of it' if one.callback == other.callback else second
    return Hit(
        place=one.place,
        message=f'{first} holds {one.held} and waits for {one.wanted}, and {whom} may hold '
        f'{other.held} and wait for {other.wanted} at the same time: both wait for ever',
        help='take the two locks in the same order everywhere, or use one lock',
        subjects=(one.callback.name, other.callback.name, one.held, one.wanted),
        chain=one.chain,
        related=(
            Remark(other.place, f'{second} takes {other.wanted} here, holding {other.held}'),
            *made_at(one.callback, other.callback),
        ),
        run=run,
    )


RULE = Rule(
    code='CC111',
    slug='lock-order',
    severity=Severity.ERROR,
    title='Locks taken in a circle',
    what='Two callbacks that may run at the same time take two locks in opposite order; or a '
    'callback takes a `threading.Lock` that it holds already. Each waits for the other, and the '
    'threads and groups they keep never come back.',
    why='A `threading.Lock` knows no owner: its holder waits for it like everybody else. Whether '
    'two callbacks may overlap is decided by the model where it was verified, else by their '
    'groups and the number of threads. Locks taken with a time-out, read locks, and circles of '
    'three are not looked at. Sources: Python, `threading`; rclpy 7.1.6 and 9.1.2, '
    '`executors.py` (`MultiThreadedExecutor`). Measured on 7.1.6: both callbacks stop within a '
    'second.',
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
