"""
What stands in the place of rclpy's methods: unseen by callers, in Python and in C.

The stand-ins have the shapes of rclpy's classes; the tests of ``tests/live`` wrap the real ones.
"""

from __future__ import annotations

import copy
import gc
import inspect
import pickle
import weakref
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from threading import Event, Lock
from types import SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.hook.groups import reporting
from ros2cc_extract.extract.live.hook.steps import (
    mark_task,
    trace_runs,
    trace_submits,
    trace_takes,
    trace_waits,
)
from ros2cc_extract.extract.live.hook.wrapping import Hook
from ros2cc_extract.extract.live.recorder.events import BEGIN, END, TAKE, rows
from ros2cc_extract.extract.live.recorder.record import Recorder
from tests.unit.live.stand_ins import (
    RCLPY,
    Broken,
    Entity,
    Executor,
    Handler,
    Pause,
    Told,
    Waiting,
    WaitSet,
    wrap,
)


@pytest.fixture(scope='module', autouse=True)
def _only_what_is_new_is_garbage() -> Iterator[None]:
    """Nothing of the thousands of other tests is looked at when these look for garbage."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


def test_group_is_reported_and_its_answer_given_back(
    recorder: Recorder, group_class: Any, told: Told
) -> None:
    group = group_class()
    entity = Entity(group)
    number = recorder.note_entity(group, entity).number
    answers = [True, False, None, [], 'yes', (1,)]
    for group.answer in answers:
        assert group.beginning_execution(entity) is group.answer
    group.answer = True
    assert group.beginning_execution(entity=entity) is True
    bound = group.beginning_execution
    assert bound(entity) is True
    assert told() == [
        ('begin' if answer else 'refused', number) for answer in [*answers, True, True]
    ]
    assert recorder.loss_count == 0


class ExternalShutdownException(Exception):  # noqa: N818
    """As that of rclpy."""


def run_in(group: Any, entity: Any, error: type[BaseException] | None) -> None:
    """As the handler of an executor: the group learns of the end, however it ends."""
    group.beginning_execution(entity)
    try:
        if error is not None:
            raise error
    finally:
        group.ending_execution(entity)


@pytest.mark.parametrize('error', [KeyboardInterrupt, ExternalShutdownException])
def test_what_is_taken_off_from_outside_has_not_ended(
    recorder: Recorder, group_class: type, told: Told, error: type[BaseException]
) -> None:
    class Group(group_class):  # type: ignore[misc]
        def ending_execution(self, entity: Any) -> None:
            pass

    method = reporting(recorder, Group, 'ending_execution', END, END)
    Group.ending_execution = method  # type: ignore[method-assign]
    group = Group()
    entity = Entity(group)
    number = recorder.note_entity(group, entity).number
    with pytest.raises(error):
        run_in(group, entity, error)
    assert told() == [('begin', number)]
    with pytest.raises(ValueError):
        run_in(group, entity, ValueError)
    try:
        raise error
    except error:
        run_in(group, entity, None)
    assert told() == [('begin', number), ('end', number)] * 2
    assert recorder.loss_count == 0


def test_wrapper_looks_like_what_it_wraps(group_class: Any) -> None:
    method = group_class.beginning_execution
    assert (method.__name__, method.__doc__) == (
        'beginning_execution',
        'Say whether it may begin.',
    )
    assert list(inspect.signature(method).parameters) == ['self', 'entity']
    assert method.__wrapped__.__code__.co_name == 'beginning_execution'
    assert group_class().beginning_execution.__self__.__class__ is group_class
    assert list(inspect.signature(group_class().beginning_execution).parameters) == ['entity']
    assert repr(method).startswith(f'<function {method.__qualname__} at 0x')
    assert inspect.isroutine(method)
    assert callable(method)


def test_wrapper_is_referred_to_copied_and_pickled_as_a_function(group_class: Any) -> None:
    group, method = group_class(), group_class.beginning_execution
    bound = weakref.WeakMethod(group.beginning_execution)
    assert bound() == group.beginning_execution
    assert copy.deepcopy(method) is copy.copy(method) is method
    globals()['Group'] = group_class
    method.__module__, method.__qualname__ = __name__, 'Group.beginning_execution'
    try:
        assert pickle.loads(pickle.dumps(method)) is method
    finally:
        del globals()['Group']
    died: list[Any] = []
    gone = weakref.ref(method, died.append)
    del group_class.beginning_execution, method, group
    gc.collect()
    assert died == [gone]


def test_method_of_another_name_is_found_in_a_subclass(recorder: Recorder, told: Told) -> None:
    def answer(self: Any, entity: Any) -> bool:
        return True

    class Group:
        beginning_execution = answer

    class Derived(Group):
        """Has no method of its own."""

    wrap(recorder, Group)
    assert Derived().beginning_execution(Entity())
    assert [name for name, _ in told()] == ['begin']
    assert recorder.loss_count == 0


def test_group_may_ask_for_more_than_an_entity(recorder: Recorder, told: Told) -> None:
    class Group:
        def beginning_execution(self, item: Any, weight: int = 0) -> int:
            return weight

    wrap(recorder, Group)
    group = Group()
    assert group.beginning_execution(Entity(), 2) == 2
    assert group.beginning_execution(Entity(), weight=0) == 0
    assert [name for name, _ in told()] == ['begin', 'refused']
    assert recorder.loss_count == 0
    # Nothing says that this is the entity, so it is counted and the group is asked all the same.
    assert group.beginning_execution(item=Entity()) == 0
    assert Group.beginning_execution(self=group, item=Entity()) == 0  # type: ignore[call-arg]
    assert (told(), recorder.loss_count) == ([], 2)


@pytest.mark.parametrize('method', [staticmethod(bool), classmethod(bool), partial(bool, 1), len])
def test_what_would_be_called_otherwise_is_no_function(recorder: Recorder, method: Any) -> None:
    Group = type('Group', (), {'beginning_execution': method})  # noqa: N806
    with pytest.raises(TypeError, match='is no function'):
        wrap(recorder, Group)
    hook = Hook('unused')
    hook._wrap_group(Group)
    assert hook.recorder.loss_count == 1
    assert vars(Group)['beginning_execution'] is method


def test_error_of_a_group_is_its_own(recorder: Recorder, group_class: Any, told: Told) -> None:
    group = group_class()
    group.answer = ValueError('none of ours')
    with pytest.raises(ValueError, match='none of ours') as caught:
        group.beginning_execution(Entity(group))
    assert caught.value is group.answer
    with pytest.raises(TypeError):
        group.beginning_execution()
    with pytest.raises(TypeError):
        group.beginning_execution(Entity(group), 1)
    assert (told(), recorder.loss_count) == ([], 0)


def test_entity_not_met_before_is_recorded(
    recorder: Recorder, group_class: Any, told: Told
) -> None:
    group = group_class()
    entity = Entity(group)
    group.beginning_execution(entity)
    (record,) = recorder.all_entities
    assert record.ref() is entity
    assert told() == [('begin', record.number)]


def test_two_hooks_are_both_told(recorder: Recorder, group_class: Any, told: Told) -> None:
    other = Recorder()
    wrap(other, group_class)
    group = group_class()
    group.beginning_execution(Entity(group))
    assert [name for name, _ in told()] == ['begin']
    assert len(other.journal) == 1
    assert (recorder.loss_count, other.loss_count) == (0, 0)


def test_subclass_that_asks_its_base_is_reported_once(
    recorder: Recorder, group_class: Any, told: Told
) -> None:
    class Careful(group_class):  # type: ignore[misc]
        def beginning_execution(self, entity: Any) -> Any:
            return not super().beginning_execution(entity)

    class Plain(group_class):  # type: ignore[misc]
        """Has no method of its own."""

    wrap(recorder, Careful)
    careful, plain = Careful(), Plain()
    mine, yours = Entity(careful), Entity(plain)
    assert careful.beginning_execution(mine) is False
    assert plain.beginning_execution(yours) is True
    numbers = [record.number for record in recorder.all_entities]
    assert told() == [('refused', numbers[0]), ('begin', numbers[1])]


@pytest.mark.parametrize('record', [Broken(), SimpleNamespace(number='one'), None])
def test_failure_of_ours_is_counted_and_changes_nothing(
    record: Any, recorder: Recorder, group_class: Any, told: Told
) -> None:
    group = group_class()
    entity = Entity(group)
    recorder.entities[id(entity)] = record
    assert group.beginning_execution(entity) is True
    assert (told(), recorder.loss_count) == ([], 1)


def test_ctrl_c_within_our_own_steps_is_not_swallowed(
    recorder: Recorder, group_class: Any
) -> None:
    class Interrupted:
        @property
        def number(self) -> int:
            raise KeyboardInterrupt

    group = group_class()
    entity = Entity(group)
    recorder.entities[id(entity)] = Interrupted()  # type: ignore[assignment]
    with pytest.raises(KeyboardInterrupt):
        group.beginning_execution(entity)
    assert recorder.loss_count == 0


def test_collecting_and_taking_are_reported(recorder: Recorder, told: Told, replaced: Any) -> None:
    trace_runs(recorder, Handler, replaced)
    trace_takes(recorder, Executor, replaced)
    entity = Entity()
    task = Executor()._make_handler(entity, 'node', lambda each: ('data of', each), 1, 2)
    (record,) = recorder.all_entities
    assert task._ros2cc_record is record  # type: ignore[attr-defined]
    assert told() == [('collect', record.number)]
    assert task() == (('data of', entity), (1, 2))
    assert told() == [('take', record.number)]
    assert recorder.loss_count == 0


def test_error_of_a_take_is_not_told_as_one(recorder: Recorder, told: Told, replaced: Any) -> None:
    trace_runs(recorder, Handler, replaced)
    trace_takes(recorder, Executor, replaced)
    task = Executor()._make_handler(Entity(), 'node', lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        task()
    with pytest.raises(ValueError, match='no entity'):
        Executor()._make_handler(None, 'node', lambda _: 1)
    with pytest.raises(TypeError):
        Executor()._make_handler(Entity())  # type: ignore[call-arg]
    assert [name for name, _ in told()] == ['collect']


def test_take_of_an_unknown_record_is_left_alone(
    recorder: Recorder, told: Told, replaced: Any
) -> None:
    trace_takes(recorder, Executor, replaced)
    entity = Entity()
    recorder.entities[id(entity)] = Broken()  # type: ignore[assignment]
    task = Executor()._make_handler(entity, 'node', lambda _: 'data')
    assert task() == ('data', ())
    assert (told(), recorder.loss_count) == ([], 1)


def test_ctrl_c_tells_of_the_error_that_it_came_upon(recorder: Recorder, replaced: Any) -> None:
    class Task(Handler):
        def executing(self) -> bool:
            raise KeyboardInterrupt

        def __call__(self) -> Any:
            raise ValueError('none of ours')

    trace_runs(recorder, Task, replaced)
    trace_takes(recorder, Executor, replaced)
    replaced(Executor, 'task_class', Task)
    task = Executor()._make_handler(Entity(), 'node', None)
    with pytest.raises(KeyboardInterrupt) as caught:
        task()
    assert repr(caught.value.__context__) == "ValueError('none of ours')"


def test_task_that_cannot_be_marked_is_given_back(
    recorder: Recorder, told: Told, replaced: Any
) -> None:
    class Closed:
        __slots__ = ('mark_raises',)

        def __init__(self, handler: Any) -> None: ...

    trace_takes(recorder, Executor, replaced)
    replaced(Executor, 'task_class', Closed)
    assert type(Executor()._make_handler(Entity(), 'node', None)) is Closed
    assert (recorder.loss_count, told()) == (1, [])


def test_nothing_of_a_task_outlives_it(recorder: Recorder, replaced: Any) -> None:
    trace_takes(recorder, Executor, replaced)
    executor, entity = Executor(), Entity()
    task: Any = executor._make_handler(entity, 'node', executor.__repr__)
    executor.tasks = [task]  # type: ignore[attr-defined]
    gone = weakref.ref(executor), weakref.ref(task)
    del executor, task
    gc.collect()
    assert [each() for each in gone] == [None, None]


def test_task_is_reported_when_it_is_first_handed_over(
    recorder: Recorder, told: Told, replaced: Any
) -> None:
    trace_runs(recorder, Handler, replaced)
    trace_takes(recorder, Executor, replaced)
    task = Executor()._make_handler(Entity(), 'node', lambda _: 'data')
    with ThreadPoolExecutor(1) as pool:
        trace_submits(recorder, SimpleNamespace(_executor=pool))
        assert pool.submit(task).result() == ('data', ())
        assert isinstance(pool.submit(task).exception(), TypeError)
        assert pool.submit(divmod, 7, 2).result() == (3, 1)
        assert pool.submit(dict, a=1).result() == {'a': 1}
        with pytest.raises(TypeError):
            pool.submit()
    assert [name for name, _ in told()] == ['collect', 'submit', 'take']
    with pytest.raises(RuntimeError):
        pool.submit(task)
    assert recorder.loss_count == 0


def test_pool_is_not_kept_alive(recorder: Recorder) -> None:
    pool = ThreadPoolExecutor(1)
    trace_submits(recorder, SimpleNamespace(_executor=pool))
    gone = weakref.ref(pool)
    del pool
    gc.collect()
    assert gone() is None


def test_coroutine_that_pauses_and_goes_on_is_reported(
    recorder: Recorder, told: Told, replaced: Any
) -> None:
    trace_runs(recorder, Handler, replaced)
    trace_takes(recorder, Executor, replaced)

    async def wait_twice() -> None:
        await Pause()
        await Pause()

    task = Executor()._make_handler(Entity(), 'node', None)
    task._handler = wait_twice()
    for _ in range(3):
        task()
    assert [name for name, _ in told()] == [
        'collect',
        'suspend',
        'resume',
        'suspend',
        'resume',
    ]
    assert task.done()


def test_a_coroutine_that_goes_on_when_another_thread_has_asked_it_in_vain_is_reported(
    recorder: Recorder, told: Told, replaced: Any
) -> None:
    """That thread is at it when this one comes, and has found nothing to do."""

    class Asked(Handler):
        is_asked = False

        def executing(self) -> bool:
            return self.is_asked

        def __call__(self) -> Any:
            return super().__call__()

    trace_runs(recorder, Asked, replaced)
    trace_takes(recorder, Executor, replaced)
    replaced(Executor, 'task_class', Asked)

    async def wait() -> None:
        await Pause()

    task: Any = Executor()._make_handler(Entity(), 'node', None)
    task._handler = wait()
    task()
    task.is_asked = True
    task()
    assert [name for name, _ in told()] == ['collect', 'suspend', 'resume']


@pytest.mark.parametrize('is_over', [False, True])
def test_a_coroutine_goes_on_in_one_of_two_threads(
    is_over: bool, recorder: Recorder, told: Told, replaced: Any
) -> None:
    """Both have found that it can; the second one is told that another thread is at it."""
    trace_runs(recorder, Shared, replaced)
    trace_takes(recorder, Executor, replaced)

    async def wait_and_work() -> str:
        await Pause()
        return task.work()

    with ThreadPoolExecutor(1) as second:
        replaced(Executor, 'task_class', staticmethod(lambda _: Shared(second, is_over)))
        task: Any = Executor()._make_handler(Entity(), 'node', None)
        task._handler = wait_and_work()
        task()
        task()
    names = [name for name, _ in told()]
    assert names[:2] == ['collect', 'suspend']
    assert sorted(names[2:]) == ['resume', 'resume', 'vain']


def test_work_outside_groups_is_reported(recorder: Recorder, told: Told, replaced: Any) -> None:
    def work() -> str:
        return 'worked'

    trace_runs(recorder, Handler, replaced)
    early, late = Handler(work), Handler(work)
    assert early() == 'worked'
    record = recorder.note_task(Entity(), 'task', work)
    assert record is not None
    mark_task(recorder, early, record)
    mark_task(recorder, late, record)
    assert late() == 'worked'
    assert [name for name, _ in told()] == ['task', 'run', 'pause'] * 2


class Shared(Handler):
    """Two workers take it at a time, and the second one finds its lock taken."""

    says_so = True

    def __init__(self, second: ThreadPoolExecutor, is_over: bool) -> None:
        super().__init__(self.work)
        self.second, self.is_over = second, is_over
        self._task_lock, self.met = Lock(), Event()

    def executing(self) -> bool:
        return self.says_so and self.met.is_set() and not self._done

    def work(self) -> str:
        taken = self.second.submit(self)
        assert self.met.wait(5.0) if self.is_over else taken.result() is None
        return 'worked'

    def __call__(self) -> Any:
        if self._task_lock.acquire(blocking=False):
            with closing(SimpleNamespace(close=self._task_lock.release)):
                return super().__call__()
        self.met.set()
        if self.is_over:
            self._task_lock.acquire(timeout=5.0)
        return None


@pytest.mark.parametrize(('is_over', 'says_so'), [(False, True), (False, False), (True, True)])
def test_a_run_in_vain_is_reported_as_such(
    is_over: bool, says_so: bool, recorder: Recorder, told: Told, replaced: Any
) -> None:
    """While another thread runs the task, or is about to, or when it has done so."""
    trace_runs(recorder, Shared, replaced)
    replaced(Shared, 'says_so', says_so)
    with ThreadPoolExecutor(1) as second:
        task = Shared(second, is_over)
        record = recorder.note_task(Entity(), 'task', task.work)
        assert record is not None
        mark_task(recorder, task, record)
        assert task() == 'worked'
    assert sorted(name for name, _ in told()) == ['pause', 'run', 'run', 'task', 'vain']


@pytest.mark.parametrize('only', [False, True])
def test_waits_of_executors_are_reported(
    only: bool, recorder: Recorder, told: Told, replaced: Any
) -> None:
    trace_waits(recorder, RCLPY, replaced)
    recorder.sees_every_executor = only
    executor = Waiting()
    number = recorder.note_executor(executor).number
    assert (recorder.only_executor is not None) == only
    assert executor.wait_for_ready_callbacks(5) == 5
    assert told() == [('wait>', number), ('wait<', number)]
    with pytest.raises(OSError, match='interrupted'):
        executor.wait_for_ready_callbacks(None)
    assert told() == [('wait>', number), ('wait<', number)]
    assert recorder.loss_count == 0


def test_other_waits_are_none_of_ours(recorder: Recorder, told: Told, replaced: Any) -> None:
    trace_waits(recorder, RCLPY, replaced)
    assert WaitSet().wait(1) == 1
    assert Waiting().wait_for_ready_callbacks(2) == 2
    assert (told(), recorder.loss_count) == ([], 0)


def test_wait_of_a_broken_record_is_counted(recorder: Recorder, replaced: Any) -> None:
    trace_waits(recorder, RCLPY, replaced)
    executor = Waiting()
    recorder.executors[id(executor)] = Broken()  # type: ignore[assignment]
    assert executor.wait_for_ready_callbacks(5) == 5
    assert recorder.loss_count


def test_end_of_a_group_is_one_whatever_it_gives(recorder: Recorder, told: Told) -> None:
    class Group:
        def ending_execution(self, entity: Any) -> None:
            """Free the group."""

    Group.ending_execution = reporting(recorder, Group, 'ending_execution', END, END)  # type: ignore[method-assign]
    group = Group()
    group.ending_execution(Entity(group))
    assert [name for name, _ in told()] == ['end']


def test_a_group_is_entered_before_a_begin_is_told_and_left_after_an_end(
    recorder: Recorder,
) -> None:
    """What gets the group begins later by the clock, however late the end is written down."""

    class Group:
        def beginning_execution(self, entity: Any) -> bool:
            recorder.journal.note(TAKE, 7)
            return True

        def ending_execution(self, entity: Any) -> None:
            recorder.journal.note(TAKE, 8)

    wrap(recorder, Group)
    Group.ending_execution = reporting(recorder, Group, 'ending_execution', END, END)  # type: ignore[method-assign]
    group = Group()
    entity = Entity(group)
    group.beginning_execution(entity)
    group.ending_execution(entity)
    told = sorted((clock, what) for (clock, _, what, _), _ in rows(recorder.take_events()))
    assert [what for _, what in told] == [TAKE, BEGIN, END, TAKE]
