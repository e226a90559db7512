"""
What is in C keeps nothing, loses nothing that it was lent, and can be called as long as it exists.

Run by an interpreter built for debugging, or with a sanitizer, these say more.
"""

from __future__ import annotations

import functools
import gc
import importlib.util
import resource
import sys
import weakref
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.hook.steps import (
    trace_runs,
    trace_submits,
    trace_takes,
    trace_waits,
)
from ros2cc_extract.extract.live.recorder import journal
from ros2cc_extract.extract.live.recorder.journal import native
from ros2cc_extract.extract.live.recorder.record import Recorder
from tests.unit.live.stand_ins import (
    RCLPY,
    Broken,
    Entity,
    Executor,
    Handler,
    Waiting,
    WaitSet,
    wrap,
)

CALLS = 2_000
PAGE_KB = resource.getpagesize() // 1024
# Of what only the system's allocator knows; the interpreter's own comes and goes.
LARGEST_GROWTH_KB = 400


class Failing:
    """Fails in every way in which an entity, a record or a task can."""

    def __getattr__(self, name: str) -> Any:
        raise ValueError(name)


class Interrupted:
    """A record, or a task, that a Ctrl-C comes in the way of."""

    @property
    def number(self) -> int:
        raise KeyboardInterrupt

    _ros2cc_record = number


def suppressed(function: Callable[..., Any], *args: Any, **named: Any) -> Callable[[], None]:
    def call() -> None:
        with suppress(ArithmeticError, OSError, TypeError, KeyboardInterrupt):
            function(*args, **named)

    return call


def ways(recorder: Recorder, replaced: Any) -> Iterator[tuple[str, Callable[[], Any]]]:
    """Give a call for every way through the C, the ways of failures included."""
    trace_runs(recorder, Handler, replaced)
    trace_takes(recorder, Executor, replaced)
    trace_waits(recorder, RCLPY, replaced)
    entity, unknown, interrupted = Entity(), Entity(), Entity()
    recorder.entities[id(entity)] = recorder.note_entity(entity.callback_group, entity)
    recorder.entities[id(unknown)] = Broken()  # type: ignore[assignment]
    recorder.entities[id(interrupted)] = Interrupted()  # type: ignore[assignment]
    yield 'make a journal', functools.partial(native.Journal, 100)
    yield from _group_ways(recorder, entity, unknown, interrupted)
    yield from _handler_ways(entity, unknown, interrupted)
    yield from _submit_ways(recorder, entity)
    executor = Waiting()
    recorder.note_executor(executor)
    yield 'wait', functools.partial(executor.wait_for_ready_callbacks, 1)
    yield 'wait in vain', suppressed(executor.wait_for_ready_callbacks, None)
    yield 'wait of others', functools.partial(WaitSet().wait, 1)
    broken = Waiting()
    recorder.executors[id(broken)] = Broken()  # type: ignore[assignment]
    yield 'wait of a broken one', functools.partial(broken.wait_for_ready_callbacks, 1)


def _group_ways(
    recorder: Recorder, entity: Entity, unknown: Entity, interrupted: Entity
) -> Iterator[Any]:
    class Group:
        answer: Any = True

        def beginning_execution(self, entity: Any, more: int = 0) -> Any:
            return 1 / more if more else self.answer

    class Derived(Group):
        def beginning_execution(self, entity: Any, more: int = 0) -> Any:
            return super().beginning_execution(entity, more)

    wrap(recorder, Group)
    wrap(recorder, Derived)
    group, derived = Group(), Derived()
    yield 'ask', functools.partial(group.beginning_execution, entity)
    yield 'ask by name', functools.partial(group.beginning_execution, entity=entity)
    yield 'ask a subclass', functools.partial(derived.beginning_execution, entity)
    yield 'ask about a broken one', functools.partial(group.beginning_execution, unknown)
    yield 'ask about another', functools.partial(group.beginning_execution, Failing())
    yield 'ask in vain', suppressed(group.beginning_execution)
    yield 'ask what fails', suppressed(group.beginning_execution, entity, 'no number')
    yield 'ask and be interrupted', suppressed(group.beginning_execution, interrupted)
    yield 'look', lambda: (repr(Group.beginning_execution), group.beginning_execution)
    yield 'refer', lambda: weakref.ref(Group.beginning_execution)


def _handler_ways(entity: Entity, unknown: Entity, interrupted: Entity) -> Iterator[Any]:
    executor: Any = Executor()
    make = executor._make_handler
    yield 'collect', functools.partial(make, entity, 'node', bool)
    yield 'collect and run', lambda: make(entity, 'node', bool)()
    yield 'fail', suppressed(lambda: make(entity, 'node', lambda _: 1 / 0)())
    yield 'collect what is broken', functools.partial(make, unknown, 'node', bool)
    yield 'collect in vain', suppressed(make, entity)
    yield 'collect many', functools.partial(make, entity, 'node', bool, *range(20))
    yield 'collect and be interrupted', suppressed(make, interrupted, 'node', bool)
    yield 'run what is not ours', lambda: Handler(bool)()
    for name, error in ('broken', Failing()), ('stopped', Interrupted.number.fget):
        task: Any = Handler(name)
        task._ros2cc_record, task.executing = SimpleNamespace(number=1), error
        yield f'run what is {name}', suppressed(lambda task=task: task())


def _submit_ways(recorder: Recorder, entity: Entity) -> Iterator[Any]:
    class Pool:
        def submit(self, task: Any, /, *args: Any, **named: Any) -> Any:
            return task

    pool: Any = Pool()
    trace_submits(recorder, SimpleNamespace(_executor=pool))
    record = recorder.entities[id(entity)]
    yield (
        'submit',
        lambda: pool.submit(SimpleNamespace(_ros2cc_record=record, _ros2cc_submitted=False)),
    )
    yield 'submit a function', functools.partial(pool.submit, divmod, 7, named=2)
    yield 'submit what is broken', functools.partial(pool.submit, Failing())
    yield 'submit in vain', suppressed(pool.submit)
    yield 'submit and be interrupted', suppressed(pool.submit, Interrupted())


def test_calls_keep_nothing(replaced: Any) -> None:
    recorder = Recorder(traced=True)
    recorder.journal = native.Journal(10)
    # Of an entity not met before there would be a record for each call.
    known = recorder.note_entity(Entity(), Entity())
    known.number = CALLS * 2
    recorder.note_entity = lambda *_: known  # type: ignore[method-assign]
    for name, call in ways(recorder, replaced):
        lent = [recorder, recorder.journal, recorder.entities, known, known.number, Handler, call]
        lent += [None, True]
        before = _held(call, 500, lent)
        after = _held(call, CALLS, lent)
        kilobytes, blocks, *counts = (now - then for now, then in zip(after, before, strict=True))
        assert kilobytes < LARGEST_GROWTH_KB, name
        assert blocks <= CALLS // 100, name  # fewer are held where caches of others were emptied
        assert counts == [pytest.approx(0, abs=CALLS // 100)] * len(counts), name


def _held(call: Callable[[], Any], times: int, lent: list[Any]) -> list[int]:
    """Count what is held after so many calls: memory in KB and in blocks, and references."""
    for _ in range(times):
        call()
    gc.collect()
    blocks = sys.getallocatedblocks()
    kilobytes = int(Path('/proc/self/statm').read_text().split()[1]) * PAGE_KB
    references = getattr(sys, 'gettotalrefcount', int)()
    return [kilobytes, blocks, references, *map(sys.getrefcount, lent)]


def test_wrapper_can_be_called_while_it_is_taken_apart() -> None:
    def call(_: Any) -> None:
        called.extend(each('task') for each in gc.get_objects() if id(each) == known)

    called: list[Any] = []
    gc.collect()
    # What is made first is taken apart first; functions of Python 3.10 cannot be called then.
    method = native.submit_function(max, 0, native.Journal(1), str, len)
    known = id(method)
    # Code is no concern of the garbage collector, so what waits for its end is reported before.
    code = compile('None', '', 'eval')
    ended = weakref.ref(code, call)
    cycle = [method, code]
    cycle.append(cycle)
    del method, code, cycle
    gc.collect()
    assert ended() is None
    assert called == ['task']


class Holder:
    """Refers to what refers to it; called, does nothing."""

    def __call__(self, *_: Any) -> None: ...


@pytest.mark.parametrize('place', ['original', 'first', 'second', 'third', 'lose', 'dict'])
def test_cycle_through_a_wrapper_is_collected(place: str) -> None:
    holder: Any = Holder()
    lent = [holder if place == each else len for each in ('original', 'first', 'second', 'third')]
    lose = holder if place == 'lose' else len
    holder.wrapper = native.run_method(lent[0], native.Journal(1), *lent[1:], lose)
    if place == 'dict':
        holder.wrapper.holder = holder
    gone = weakref.ref(holder)
    gc.collect()
    del holder, lent, lose
    assert gone() is not None
    gc.collect()
    assert gone() is None


def test_wrapper_is_made_here_only_and_of_no_other_class(recorder: Recorder) -> None:
    class Group:
        def beginning_execution(self, entity: Any) -> bool:
            return True

    wrap(recorder, Group)
    made = type(Group.beginning_execution)
    if made is type(test_calls_keep_nothing):
        return
    with pytest.raises(TypeError):
        made()
    with pytest.raises(TypeError):
        object.__new__(made)
    with pytest.raises(TypeError):
        type('Derived', (made,), {})
    with pytest.raises(TypeError):
        Group.beginning_execution.__class__ = Entity


def test_same_code_under_two_names_is_one(recorder: Recorder) -> None:
    """The hook has a package of its own, and a program may have the tool's as well."""
    spec = importlib.util.spec_from_file_location('another._journal', native.__file__)
    assert spec is not None
    assert spec.loader is not None
    other = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(other)
    assert other is not native
    assert other.Journal is native.Journal
    made = other.submit_function(divmod, 1, native.Journal(1), lambda: 7, print)
    assert made(2) == (3, 1)


@pytest.mark.parametrize('kept', [0, -1, 2**62, 2**100, 'many'])
def test_journal_that_cannot_be_is_refused(kept: Any) -> None:
    with pytest.raises((ValueError, OverflowError, MemoryError, TypeError)):
        native.Journal(kept)


def test_what_was_built_of_another_text_is_not_used(monkeypatch: pytest.MonkeyPatch) -> None:
    assert journal._load_native() is native
    monkeypatch.setattr(native, 'REVISION', 1)
    assert journal._load_native() is None
