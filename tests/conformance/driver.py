"""
Runs random node programs on the real executors, one after the other in this process.

``python driver.py OUT SEED...`` under ``ros2cc-extract run --trace``, by an interpreter that has
rclpy. Writes one line of JSON for each program: its seed, when it was over (what happens after
that belongs to the tidying up), and what arrived for whom, if the program reports it.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
import warnings
from collections import Counter
from typing import Any

import programs
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.task import Future
from std_msgs.msg import Empty as Message
from std_srvs.srv import Empty as Service

PATIENCE_S = 5.0


class Built:
    """The nodes, groups and entities of one program."""

    def __init__(self, program: programs.Program, outside: Any) -> None:
        self.program = program
        self.over = threading.Event()
        self.spinning = 0
        self.outside = outside
        self.executor = self._executor()
        self.nodes = [
            rclpy.create_node(
                program.node_name(n), start_parameter_services=False, enable_rosout=False
            )
            for n in range(program.nodes)
        ]
        self.groups = [
            ReentrantCallbackGroup() if g.reentrant else MutuallyExclusiveCallbackGroup()
            for g in program.groups
        ]
        self.ran = {e.number: threading.Event() for e in program.entities}
        self.awaited: dict[int, list[Future]] = {e.number: [] for e in program.entities}
        self.made: dict[int, Any] = {}
        self.feeders: dict[int, Any] = {}
        self.is_warm = not program.tells_arrivals
        self.arrivals: list[tuple[int, int, int, int]] = []
        self.runs: Counter[int] = Counter()
        for entity in program.entities:
            self.made[entity.number] = self._make(entity)
        for node in self.nodes:
            self.executor.add_node(node)

    def _executor(self) -> Any:
        if self.program.executor == programs.MULTI:
            with warnings.catch_warnings():
                warnings.simplefilter('ignore')
                return MultiThreadedExecutor(num_threads=self.program.threads)
        if self.program.executor == programs.EVENTS:
            from rclpy.experimental import EventsExecutor

            return EventsExecutor()
        return SingleThreadedExecutor()

    def _make(self, entity: programs.Entity) -> Any:
        node, group = self.nodes[entity.node], self.groups[entity.group]
        callback = self._callback(entity)
        if entity.kind == programs.TIMER:
            return node.create_timer(entity.period_s, callback, callback_group=group)
        if entity.kind == programs.SUBSCRIPTION:
            depth = programs.MESSAGES_KEPT if self.program.tells_arrivals else 20
            self.feeders[entity.number] = self.outside.create_publisher(Message, entity.key, depth)
            return node.create_subscription(
                Message, entity.key, callback, depth, callback_group=group
            )
        if entity.kind == programs.GUARD:
            return node.create_guard_condition(callback, callback_group=group)
        if entity.kind == programs.SERVICE:
            self.feeders[entity.number] = self.outside.create_client(Service, entity.key)
            return node.create_service(Service, entity.key, callback, callback_group=group)
        if entity.kind == programs.CLIENT:
            server = programs.server_of(self.program, entity)
            key = server.key if server else ANSWERING
            return node.create_client(Service, key, callback_group=group)
        return callback

    def _callback(self, entity: programs.Entity) -> Any:
        if any(effect.what.startswith('await') for effect in entity.effects):
            return self._named(self._coroutine(entity), entity)
        return self._named(self._function(entity), entity)

    def _named(self, function: Any, entity: programs.Entity) -> Any:
        function.__name__ = entity.name
        function.__qualname__ = f'p{programs.label(self.program.seed)}.{entity.name}'
        return function

    def _function(self, entity: programs.Entity) -> Any:
        def callback(*data: Any) -> Any:
            self._work(entity)
            for effect in entity.effects if self.is_warm else ():
                self._do(effect)
            self._signal(entity)
            return data[-1] if data else None

        return _with_parameters(callback, entity)

    def _coroutine(self, entity: programs.Entity) -> Any:
        async def callback(*data: Any) -> Any:
            self._work(entity)
            for effect in entity.effects:
                if not effect.what.startswith('await'):
                    self._do(effect)
                elif not self.over.is_set():
                    await self._future(effect)
            self._work(entity)
            self._signal(entity)
            return data[-1] if data else None

        return _with_parameters(callback, entity)

    def _work(self, entity: programs.Entity) -> None:
        if entity.work_s:
            time.sleep(entity.work_s)
        until = time.monotonic() + entity.spin_s
        while time.monotonic() < until:
            pass

    def _signal(self, entity: programs.Entity) -> None:
        self.runs[entity.number] += 1
        self.ran[entity.number].set()
        waiting, self.awaited[entity.number] = self.awaited[entity.number], []
        for future in waiting:
            future.set_result(None)

    def _do(self, effect: programs.Effect) -> None:
        if effect.what == 'call':
            self._call(self.made[effect.on])
        elif effect.what == 'spin_call':
            self._spin_call(self.made[effect.on])
        elif effect.what == 'wait':
            self._wait(self.ran[effect.on])
        elif effect.what == 'make_task':
            self.executor.create_task(self.made[effect.on])
        elif effect.what == 'publish':
            self.feed(effect.on)

    def _wait(self, event: threading.Event) -> None:
        while not event.wait(0.02) and not self.over.is_set():
            pass

    def _call(self, client: Any) -> None:
        """As ``Client.call``, but it lets go when the program is over."""
        answered = threading.Event()
        future = client.call_async(Service.Request())
        future.add_done_callback(lambda _: answered.set())
        self._wait(answered)

    def _spin_call(self, client: Any) -> None:
        """
        As ``spin_until_future_complete``, but it lets go when the program is over.

        Of more requests at a time than are kept, the answers of some would never come.
        """
        if self.spinning >= programs.SPINS_AT_A_TIME:
            return
        self.spinning += 1
        future = client.call_async(Service.Request())
        while not future.done() and not self.over.is_set():
            self.executor.spin_until_future_complete(future, timeout_sec=0.05)
        self.spinning -= 1

    def _future(self, effect: programs.Effect) -> Any:
        if effect.what == 'await_call':
            return self.made[effect.on].call_async(Service.Request())
        future: Future = Future()
        self.awaited[effect.on].append(future)
        return future

    def feed(self, number: int) -> None:
        """Let something arrive for an entity, and note when."""
        earliest_ns = time.monotonic_ns()
        self._hand_over(number)
        if number in self.feeders:
            thread = threading.get_ident()
            self.arrivals.append((number, thread, earliest_ns, time.monotonic_ns()))

    def _hand_over(self, number: int) -> None:
        kind = self.program.entities[number].kind
        if kind == programs.SUBSCRIPTION:
            self.feeders[number].publish(Message())
        elif kind == programs.GUARD:
            self.made[number].trigger()
        elif kind == programs.SERVICE:
            self.feeders[number].call_async(Service.Request())

    def is_connected(self) -> bool:
        """Whether everybody has found each other."""
        for number, feeder in self.feeders.items():
            entity = self.program.entities[number]
            if entity.kind == programs.SUBSCRIPTION and not feeder.get_subscription_count():
                return False
            if entity.kind == programs.SERVICE and not feeder.service_is_ready():
                return False
        clients = [e for e in self.program.entities if e.kind == programs.CLIENT]
        return all(self.made[e.number].service_is_ready() for e in clients)

    def run(self) -> int:
        """Run for as long as the feeds last; say when it was over, by the monotonic clock."""
        until = time.monotonic() + PATIENCE_S
        while not self.is_connected() and time.monotonic() < until:
            time.sleep(0.002)
        spinning = threading.Thread(target=self._spin)
        spinning.start()
        if not self.is_warm:
            self._warm_up()
        for pause, number in self.program.feeds:
            if pause:
                time.sleep(pause)
            if number >= 0:
                self.feed(number)
        if self.program.tells_arrivals:
            self._serve_all()
        ended = time.monotonic_ns()
        assert spinning.is_alive(), f'program {self.program.seed}: the executor has stopped'
        self._tidy_up(spinning)
        return ended

    def _warm_up(self) -> None:
        """
        Feed everybody once: the first message may be on its way for long.

        One side may know of the other sooner than the other way round (Fast DDS).
        """
        begun_ns = time.monotonic_ns()
        for number in self.feeders:
            self._hand_over(number)
        self.is_warm = self._have_run(Counter(self.feeders.keys()))
        ended_ns = time.monotonic_ns()
        self.arrivals += [(number, -number, begun_ns, ended_ns) for number in self.feeders]

    def _serve_all(self) -> None:
        """Wait until all that has arrived is served, and was not lost."""
        self._have_run(Counter(number for number, *_ in tuple(self.arrivals)))

    def _have_run(self, runs: Counter[int]) -> bool:
        until = time.monotonic() + PATIENCE_S
        while not self.runs >= runs and time.monotonic() < until:
            time.sleep(0.002)
        return self.runs >= runs

    def _spin(self) -> None:
        while not self.over.is_set():
            self.executor.spin_once(timeout_sec=0.05)

    def _tidy_up(self, spinning: threading.Thread) -> None:
        self.over.set()
        for futures in self.awaited.values():
            for future in futures:
                future.cancel()
        spinning.join(PATIENCE_S)
        self.executor.shutdown(timeout_sec=1.0)
        pool = getattr(self.executor, '_executor', None)
        if pool is not None:
            pool.shutdown(wait=True)
        for feeder in self.feeders.values():
            destroy = (
                self.outside.destroy_publisher
                if hasattr(feeder, 'publish')
                else self.outside.destroy_client
            )
            destroy(feeder)
        for node in self.nodes:
            node.destroy_node()


ANSWERING = 'answering'


def _with_parameters(callback: Any, entity: programs.Entity) -> Any:
    """rclpy counts the parameters of a callback."""
    import inspect

    is_async = inspect.iscoroutinefunction(callback)
    if entity.kind == programs.SUBSCRIPTION:
        if is_async:

            async def with_message(message: Any) -> None:
                await callback(message)
        else:

            def with_message(message: Any) -> None:
                callback(message)

        return with_message
    if entity.kind == programs.SERVICE:
        if is_async:

            async def with_request(request: Any, response: Any) -> Any:
                return await callback(request, response)
        else:

            def with_request(request: Any, response: Any) -> Any:
                return callback(request, response)

        return with_request
    if is_async:

        async def with_nothing() -> None:
            await callback()
    else:

        def with_nothing() -> None:
            callback()

    return with_nothing


def main(out: str, seeds: list[int]) -> None:
    rclpy.init()
    outside = rclpy.create_node('outside', start_parameter_services=False, enable_rosout=False)
    answering = rclpy.create_node('answering', start_parameter_services=False)
    answering.create_service(Service, ANSWERING, lambda request, response: response)
    others = SingleThreadedExecutor()
    others.add_node(answering)
    over = threading.Event()

    def serve() -> None:
        while not over.is_set():
            others.spin_once(timeout_sec=0.05)

    helper = threading.Thread(target=serve)
    helper.start()
    # What rclpy says of callbacks that it finds unfinished when a program is over.
    with open(os.devnull, 'w') as sys.stderr, open(out, 'w') as stream:  # noqa: PTH123
        try:
            for seed in seeds:
                built = Built(programs.draw(seed), outside)
                row = {'seed': seed, 'ended': built.run()}
                if built.program.tells_arrivals and built.is_warm:
                    row['arrivals'] = built.arrivals
                stream.write(json.dumps(row) + '\n')
        finally:
            sys.stderr = sys.__stderr__
    over.set()
    helper.join()
    others.shutdown()
    rclpy.shutdown()


if __name__ == '__main__':
    main(sys.argv[1], [int(seed) for seed in sys.argv[2:]])
