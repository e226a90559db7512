"""The same calls, one after the other, come to the same in Python and in C."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2cc_extract.extract.live.hook import groups, steps
from ros2cc_extract.extract.live.recorder import journal
from ros2cc_extract.extract.live.recorder.events import EVENT_NAMES, rows
from ros2cc_extract.extract.live.recorder.record import Recorder
from tests.unit.live.stand_ins import Entity, Executor, Handler, Pause, Waiting, WaitSet, wrap

ERRORS: tuple[type[BaseException], ...] = (ValueError, KeyError, KeyboardInterrupt, SystemExit)
RAISES = st.sampled_from(ERRORS)


class Bool:
    """Fails when it is asked whether it is true."""

    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def __bool__(self) -> bool:
        raise self.error('no truth')

    def __repr__(self) -> str:
        return f'Bool({self.error.__name__})'


class Failing:
    """A record, or something of a task: raises whatever is asked of it."""

    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def __getattr__(self, name: str) -> Any:
        raise self.error(name)

    def __call__(self) -> Any:
        raise self.error('called')


ANSWERS = st.one_of(st.sampled_from([True, False, None, 0, 'yes', (1,)]), RAISES, RAISES.map(Bool))
# With numbers that exist; C reports others sooner.
RECORDS = st.one_of(
    st.sampled_from([None, 'unknown', 'raising find']),
    st.sampled_from([0, 2**32 - 1, True]).map(lambda n: SimpleNamespace(number=n)),
    RAISES.map(Failing),
)
INDEX = st.integers(0, 2)
HANDLERS = st.one_of(
    st.just('take'),
    st.tuples(st.just('coroutine'), st.integers(0, 3), st.one_of(st.none(), RAISES)),
    RAISES.map(Failing),
    st.none(),
)
DEEDS = st.one_of(
    st.tuples(st.just('know'), INDEX, RECORDS),
    st.tuples(
        st.just('ask'),
        st.sampled_from(['Group', 'Derived', 'Asking', 'Renamed']),
        INDEX,
        ANSWERS,
        st.sampled_from(['place', 'name', 'class', 'more', 'other name', 'nothing', 'bound']),
    ),
    st.tuples(
        st.just('collect'),
        INDEX,
        st.one_of(st.none(), RAISES),
        st.sampled_from(['place', 'more', 'names', 'few']),
    ),
    st.tuples(st.just('handle'), INDEX, HANDLERS),
    st.tuples(st.just('run'), INDEX),
    st.tuples(st.just('break'), INDEX, st.sampled_from(['executing', 'done', '_ros2cc_record',
        '_ros2cc_suspended', '_ros2cc_submitted', '_handler', '_ros2cc_awaited']),
        st.one_of(st.sampled_from([None, True, False]), RAISES.map(Failing), RAISES.map(Bool))),
    st.tuples(st.just('work'), INDEX),
    st.tuples(st.just('submit'), INDEX, st.sampled_from(['task', 'function', 'nothing', 'named'])),
    st.tuples(st.just('drop the pool')),
    st.tuples(st.just('wait'), INDEX, st.sampled_from([1, None]), st.booleans()),
    st.tuples(st.just('know executor'), INDEX, RECORDS),
    st.tuples(st.just('only executor'), RECORDS),
    st.tuples(st.just('lose'), st.one_of(st.none(), RAISES)),
    st.tuples(st.just('mark'), st.one_of(st.none(), RAISES)),
)  # fmt: skip


@pytest.mark.filterwarnings('ignore:coroutine .* was never awaited')
@given(st.lists(DEEDS, max_size=25))
def test_same_calls_come_to_the_same(effects: list[tuple[Any, ...]]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        native = list(_World().live(effects))
        for module in (groups, journal, steps):
            patch.setattr(module, 'native', None)
        plain = list(_World().live(effects))
    assert native == plain


class _Recorder(Recorder):
    """Fails when told to."""

    lose_raises: type[BaseException] | None = None

    def lose(self, error: BaseException) -> None:
        super().lose(error)
        self.all_losses = [*getattr(self, 'all_losses', ()), type(error).__name__]
        if self.lose_raises is not None:
            raise self.lose_raises('lose')

    def note_entity(self, group: Any, entity: Any, creation: Any = None) -> Any:
        if getattr(entity, 'cannot_be_noted', False):
            raise LookupError('find')
        return super().note_entity(group, entity, creation)


class _World:
    """Classes of its own, wrapped, with what the effects are done to."""

    def __init__(self) -> None:
        self.recorder = _Recorder(traced=True)
        self.entities = [Entity() for _ in range(3)]
        self.executor_class = type('Executor', (), {**vars(Executor)})
        self.task_class: Any = type('Task', (_Task,), {'__call__': _Task.__call__})
        waits = type('WaitSet', (), {'wait': WaitSet.wait})
        executors = SimpleNamespace(Executor=Waiting, _rclpy=SimpleNamespace(WaitSet=waits))
        self.wait_set: Any = waits()
        steps.trace_runs(self.recorder, self.task_class, setattr)
        steps.trace_takes(self.recorder, self.executor_class, setattr)
        steps.trace_waits(self.recorder, executors, setattr)
        self.executor: Any = self.executor_class()
        self.executor.task_class = self.task_class
        self.executors = [_waiting(self.wait_set) for _ in range(3)]
        self.groups = _groups(self.recorder)
        self.tasks: list[Any] = [self.task_class(lambda: 'ran') for _ in range(3)]
        self.pool: Any = _Pool()
        steps.trace_submits(self.recorder, SimpleNamespace(_executor=self.pool))
        self.submit = self.pool.submit
        for index in range(2):
            self.do_collect(index, None, 'place')

    def live(self, effects: list[tuple[Any, ...]]) -> Iterator[Any]:
        for name, *told in effects:
            yield name, _outcome(getattr(self, f'do_{name.replace(" ", "_")}'), *told)
            events = [
                (EVENT_NAMES[what], number)
                for (_, _, what, number), _ in rows(self.recorder.journal.take(1000))
            ]
            yield events, getattr(self.recorder, 'all_losses', []), self.recorder.loss_count

    def do_know(self, index: int, record: Any) -> None:
        entity: Any = self.entities[index]
        entity.cannot_be_noted = record == 'raising find'
        if record is None or isinstance(record, str):
            self.recorder.entities.pop(id(entity), None)
        else:
            self.recorder.entities[id(entity)] = record

    def do_ask(self, cls: str, index: int, answer: Any, how: str) -> Any:
        group, entity = self.groups[cls](answer), self.entities[index]
        method = group.beginning_execution
        if how == 'class':
            return type(group).beginning_execution(group, entity)
        calls: dict[str, Callable[[], Any]] = {
            'place': lambda: group.beginning_execution(entity),
            'name': lambda: method(entity=entity),
            'more': lambda: method(entity, 1),
            'other name': lambda: method(item=entity),
            'nothing': lambda: method(),
            'bound': lambda: method(entity),
        }
        return calls[how]()

    def do_collect(self, index: int, error: type[BaseException] | None, how: str) -> Any:
        def take(entity: Any) -> Any:
            if error is not None:
                raise error('taken')
            return 'data'

        given: dict[str, tuple[tuple[Any, ...], dict[str, Any]]] = {
            'place': (('node', take), {}),
            'more': (('node', take, 1, 2), {}),
            'names': (('node',), {'take': take}),
            'few': (('node',), {}),
        }
        args, named = given[how]
        self.tasks[index] = self.executor._make_handler(self.entities[index], *args, **named)
        return sorted(vars(self.tasks[index]))

    def do_handle(self, index: int, handler: Any) -> None:
        if isinstance(handler, tuple):
            handler = _pausing(*handler[1:])
        if handler != 'take':
            self.tasks[index]._handler = handler

    def do_run(self, index: int) -> Any:
        return self.tasks[index]()

    def do_break(self, index: int, name: str, value: Any) -> None:
        task = self.tasks[index]
        setattr(task, name, (lambda: value) if name in ('executing', 'done') else value)

    def do_work(self, index: int) -> None:
        record = self.recorder.note_task(self.executor, 'task', _work)
        assert record is not None
        steps.mark_task(self.recorder, self.tasks[index], record)

    def do_submit(self, index: int, how: str) -> Any:
        calls: dict[str, Callable[[], Any]] = {
            'task': lambda: self.submit(self.tasks[index]),
            'function': lambda: self.submit(divmod, 7, 2),
            'nothing': lambda: self.submit(),
            'named': lambda: self.submit(dict, a=1),
        }
        return calls[how]()

    def do_drop_the_pool(self) -> None:
        self.pool = None

    def do_wait(self, index: int, timeout: Any, ours: bool) -> Any:
        if not ours:
            return self.wait_set.wait(timeout=timeout)
        return self.executors[index].wait_for_ready_callbacks(timeout)

    def do_know_executor(self, index: int, record: Any) -> None:
        executor = self.executors[index]
        if isinstance(record, str):
            self.recorder.note_executor(executor)
        else:
            self.recorder.executors[id(executor)] = record

    def do_only_executor(self, record: Any) -> None:
        self.recorder.only_executor = None if isinstance(record, str) else record

    def do_lose(self, error: type[BaseException] | None) -> None:
        self.recorder.lose_raises = error

    def do_mark(self, error: type[BaseException] | None) -> None:
        self.executor.mark_raises = error


def _outcome(effect: Callable[..., Any], *given: Any) -> Any:
    try:
        return 'gave', repr(effect(*given))
    except BaseException as error:
        return 'raised', _name(error), _name(error.__context__)


def _waiting(wait_set: Any) -> Any:
    """Give an executor that waits in the code of ``Waiting``, by a wait set of its world."""
    executor: Any = Waiting()
    executor.wait_set = wait_set
    return executor


def _groups(recorder: Recorder) -> dict[str, Any]:
    class Group:
        def __init__(self, answer: Any) -> None:
            self.answer = answer

        def beginning_execution(self, entity: Any, more: int = 0) -> Any:
            if isinstance(self.answer, type):
                raise self.answer('answered')
            return more or self.answer

    class Derived(Group):
        """Has no method of its own."""

    class Asking(Group):
        def beginning_execution(self, item: Any, *more: Any) -> Any:
            return super().beginning_execution(item, *more)

    def renamed(self: Any, entity: Any) -> Any:
        return self.answer

    lending = type('Lending', (), {'beginning_execution': renamed, '__init__': Group.__init__})
    for each in (Group, Asking, lending):
        wrap(recorder, each)
    borrowing = type('Renamed', (lending,), {})
    return {'Group': Group, 'Derived': Derived, 'Asking': Asking, 'Renamed': borrowing}


def _name(error: BaseException | None) -> str:
    return type(error).__name__


class _Task(Handler):
    """May refuse to be marked."""

    mark_raises: type[BaseException] | None = None

    def __setattr__(self, name: str, value: Any) -> None:
        if name == '_ros2cc_record' and self.mark_raises is not None:
            raise self.mark_raises('marked')
        super().__setattr__(name, value)


class _Pool:
    def submit(self, function: Any, /, *args: Any, **named: Any) -> Any:
        return function(*args, **named)


def _work() -> str:
    return 'worked'


async def _pausing(times: int, error: type[BaseException] | None) -> None:
    for _ in range(times):
        await Pause()
    if error is not None:
        raise error('at the end')
