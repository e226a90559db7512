"""
What is wrapped in rclpy so that a running process reports what its executors hold.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Executors and groups are wrapped, callbacks never. Each wrapper calls the original
first, gives back what that gave, and swallows and counts its own failures.
"""

from __future__ import annotations

import atexit
import functools
import inspect
import os
import sys
import time
from collections.abc import Callable
from typing import Any

from ..exploring.exploration import explore_from_environment
from ..recorder.events import BEGIN, END, REFUSED
from ..recorder.frames import is_node, trace_creation
from ..recorder.record import Recorder
from ..steering.steer import steer_from_environment
from .diagnostics import VARIABLE as DIAGNOSTICS_VARIABLE
from .diagnostics import Diagnostics
from .events_executor import mark_spinning, measure_callbacks
from .flight import FlightRecorder
from .groups import reporting
from .steps import mark_task, trace_runs, trace_submits, trace_takes, trace_waits
from .watch import VARIABLE as WATCH_VARIABLE
from .watch import Watch, limit_of
from .writer import Writer

OUTPUT_VARIABLE = 'ROS2CC_LIVE_DIR'
TRACE_VARIABLE = 'ROS2CC_LIVE_TRACE'
WATCHED_MODULE = 'rclpy.executors'
# Types whose callbacks the executor written in C++ calls itself.
MEASURED_FOR_EVENTS = (
    ('rclpy.timer', 'Timer'),
    ('rclpy.subscription', 'Subscription'),
    ('rclpy.service', 'Service'),
)


class Hook:
    """The recorder of this process, its writer, and what is wrapped."""

    def __init__(
        self,
        directory: str,
        *,
        traced: bool = False,
        limit_s: float | None = None,
        published: bool = False,
    ) -> None:
        self.recorder = Recorder(traced=traced)
        flight = watch = None
        if limit_s is not None:
            flight = FlightRecorder(self.recorder)
            watch = Watch(self.recorder, limit_s, flight)
        self.writer = Writer(
            self.recorder,
            lambda: _file_of_process(directory),
            traced=traced,
            watch=watch,
            flight=flight,
            diagnostics=Diagnostics(self.recorder) if published else None,
        )
        self._traced = traced
        self._wrapped: list[tuple[type, str, Any]] = []
        self._measures_events = False
        #: Called once rclpy is loaded and wrapped.
        self.afterwards: Callable[[], None] | None = None

    def install(self) -> None:
        """Wrap rclpy now if it is loaded, else as soon as it will be."""
        os.register_at_fork(after_in_child=self._after_fork)
        atexit.register(self._at_exit)
        loaded = sys.modules.get(WATCHED_MODULE)
        if loaded is not None:
            self.wrap(loaded)
        else:
            sys.meta_path.insert(0, _Finder(self._wrap_at_once, self.recorder.lose))

    def _wrap_at_once(self, executors: Any) -> None:
        """Wrap what was loaded just now, before any code can have made an executor."""
        self.recorder.sees_every_executor = self.wrap(executors)
        if self.afterwards is not None:
            self.afterwards()

    def wrap(self, executors: Any) -> bool:
        """
        Wrap the classes of ``rclpy.executors`` and ``rclpy.callback_groups``.

        A release may lack what another has: that is counted as lost, and the rest is wrapped.

        :return: whether all was there.
        """
        steps = [self._wrap_executor, self._wrap_events_executor, self._wrap_groups]
        if self._traced:
            steps += [self._trace_waits, self._trace_takes, self._trace_runs, self._trace_pools]
        done = [self._is_done(step, executors) for step in steps]
        return all(done)

    def _is_done(self, step: Callable[[Any], None], executors: Any) -> bool:
        try:
            step(executors)
        except Exception as error:
            self.recorder.lose(error)
            return False
        return True

    def _wrap_executor(self, executors: Any) -> None:
        base = executors.Executor
        self._replace(base, '__init__', self._executor_made)
        self._replace(base, 'add_node', self._node_added)
        self._replace(base, 'remove_node', self._node_removed)
        self._replace(base, 'wake', self._woken)
        self._replace(base, 'create_task', self._task_created)

    def _wrap_events_executor(self, executors: Any) -> None:
        """Wrap the executor written in C++, which has no Python base class."""
        events = getattr(getattr(executors, '_rclpy', None), 'EventsExecutor', None)
        if events is not None:
            self._replace(events, 'add_node', self._node_added_for_events)
            self._replace(events, 'remove_node', self._node_removed)
            self._replace(events, 'create_task', self._task_created)
            mark_spinning(events, self._set)

    def _wrap_groups(self, _executors: Any) -> None:
        groups = sys.modules['rclpy.callback_groups']
        self._replace(groups.CallbackGroup, '__init__', self._group_made)
        self._replace(groups.CallbackGroup, 'add_entity', self._entity_added)
        for group in _subclasses(groups.CallbackGroup):
            self._wrap_group(group)
        self._watch_new_groups(groups.CallbackGroup)

    def _trace_waits(self, executors: Any) -> None:
        trace_waits(self.recorder, executors, self._set)

    def _trace_takes(self, executors: Any) -> None:
        trace_takes(self.recorder, executors.Executor, self._set)

    def _trace_runs(self, executors: Any) -> None:
        trace_runs(self.recorder, executors.Task, self._set)

    def _trace_pools(self, executors: Any) -> None:
        self._replace(executors.MultiThreadedExecutor, '__init__', self._pool_made)

    def unwrap(self) -> None:
        """Put everything back."""
        for owner, name, original in reversed(self._wrapped):
            if original is None:
                delattr(owner, name)
            else:
                setattr(owner, name, original)
        self._wrapped.clear()
        self._measures_events = False

    def _replace(self, owner: type, name: str, note: Callable[..., None]) -> None:
        """Call ``note(result, self, …)`` after each call of a method."""
        original = inspect.getattr_static(owner, name)  # of a base in some releases
        lose = self.recorder.lose

        @functools.wraps(original)
        def method(instance: Any, *args: Any, **kwargs: Any) -> Any:
            result = original(instance, *args, **kwargs)
            try:
                note(result, instance, *args, **kwargs)
            except Exception as error:
                lose(error)
            return result

        self._set(owner, name, method)

    def _set(self, owner: type, name: str, value: Any) -> None:
        self._wrapped.append((owner, name, owner.__dict__.get(name)))
        setattr(owner, name, value)

    def _executor_made(self, _result: None, executor: Any, *_: Any, **__: Any) -> None:
        # This method, the wrapper and so on outwards to the class's own __init__.
        frame = sys._getframe(2)
        record = self.recorder.note_executor(executor, trace_creation(frame, executor).place)
        record.default_threads = frame.f_locals.get('num_threads', ...) is None
        self.writer.start()

    def _node_added(self, added: bool | None, executor: Any, node: Any) -> None:
        if added is not False:
            self.recorder.note_added(executor, node)
            self.writer.start()

    def _node_added_for_events(self, added: bool, executor: Any, node: Any) -> None:
        if not self._measures_events:
            self._measures_events = True
            for module, name in MEASURED_FOR_EVENTS:
                measure_callbacks(self.recorder, getattr(sys.modules[module], name), self._set)
        self._node_added(added, executor, node)

    def _node_removed(self, _result: None, executor: Any, node: Any) -> None:
        self.recorder.note_removed(executor, node)

    def _woken(self, _result: None, _executor: Any) -> None:
        self.recorder.changes += 1

    def _task_created(self, task: Any, executor: Any, callback: Any, *_: Any, **__: Any) -> None:
        asked_by = sys._getframe(2).f_globals.get('__name__')
        kind = 'done_callback' if asked_by == 'rclpy.task' else 'task'
        record = self.recorder.note_task(executor, kind, callback)
        if self._traced and record is not None:
            mark_task(self.recorder, task, record)

    def _pool_made(self, _result: None, executor: Any, *_: Any, **__: Any) -> None:
        trace_submits(self.recorder, executor)

    def _group_made(self, _result: None, group: Any) -> None:
        creation = trace_creation(sys._getframe(2), group)
        node, creation.node = creation.node, None
        self.recorder.note_group(group, creation)
        if is_node(node):
            self.recorder.note_node(node)

    def _entity_added(self, _result: None, group: Any, entity: Any) -> None:
        creation = trace_creation(sys._getframe(2), entity)
        self.recorder.note_entity(group, entity, creation)

    def _watch_new_groups(self, base: Any) -> None:
        """Wrap group classes that are defined later, when they are defined."""
        wrap_group, lose = self._wrap_group, self.recorder.lose

        def init_subclass(cls: Any, /, **kwargs: Any) -> None:
            super(base, cls).__init_subclass__(**kwargs)
            try:
                wrap_group(cls)
            except Exception as error:
                lose(error)

        self._set(base, '__init_subclass__', classmethod(init_subclass))

    def _wrap_group(self, group: type) -> None:
        for name, what, otherwise in (
            ('beginning_execution', BEGIN, REFUSED),
            ('ending_execution', END, END),
        ):
            if name in group.__dict__:
                try:
                    wrapper = reporting(self.recorder, group, name, what, otherwise)
                except TypeError as error:
                    self.recorder.lose(error)
                else:
                    self._set(group, name, wrapper)

    def _after_fork(self) -> None:
        try:
            self.recorder.forget()
            self.writer.forget()
        except Exception as error:
            self.recorder.lose(error)

    def _at_exit(self) -> None:
        try:
            self.writer.finish()
        except (Exception, KeyboardInterrupt) as error:
            # A Ctrl-C that arrives only now would be shown as ours; the program is over anyway.
            self.recorder.lose(error)


class _Finder:
    """Lets the other finders find rclpy's executors, and wraps them once they are loaded."""

    def __init__(self, wrap: Callable[[Any], None], lose: Callable[[BaseException], None]) -> None:
        self._wrap = wrap
        self._lose = lose

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        if name != WATCHED_MODULE:
            return None
        sys.meta_path.remove(self)
        for finder in sys.meta_path:
            spec = finder.find_spec(name, path, target)
            if spec is not None:
                self._follow(spec.loader)
                return spec
        return None

    def _follow(self, loader: Any) -> None:
        execute = loader.exec_module

        def exec_module(module: Any) -> None:
            execute(module)
            try:
                self._wrap(module)
            except Exception as error:
                self._lose(error)

        loader.exec_module = exec_module


def install(directory: str, *, traced: bool = False) -> Hook:
    """Install the hook; recordings go into ``directory``, one file for each process."""
    limit_s = limit_of(os.environ.get(WATCH_VARIABLE))
    published = os.environ.get(DIAGNOSTICS_VARIABLE) == '1'
    hook = Hook(directory, traced=traced, limit_s=limit_s, published=published)
    hook.install()
    return hook


def install_from_environment() -> Hook | None:
    """Install the hook if the environment asks for it."""
    directory = os.environ.get(OUTPUT_VARIABLE)
    traced = os.environ.get(TRACE_VARIABLE) == '1'
    if not directory:
        return None
    hook = install(directory, traced=traced)
    steering = steer_from_environment() or explore_from_environment()
    if steering is not None:
        hook.afterwards = steering.wrap
    return hook


def _file_of_process(directory: str) -> str:
    """Give a name that no other process uses, not even one that gets the same number later."""
    return f'{directory}/{os.getpid()}-{time.time_ns():x}.json'


def _subclasses(cls: type) -> list[type]:
    found: list[type] = cls.__subclasses__()
    return found + [deeper for sub in found for deeper in _subclasses(sub)]
