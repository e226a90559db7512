"""
Random node programs that wait in all the ways users write.

A program is one node on one executor, with timers, a subscription, services and threads of its
own, whose bodies wait for and wake each other. Equal seeds give equal texts.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field

from tests.random_waits.kinds import KINDS

THREADS = (1, 1, 2, 2, 3)
_HEAD = """\
import asyncio
import concurrent.futures
import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


"""
_MAIN = """\


def main():
    rclpy.init()
    node = Waiter()
    executor = {executor}
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
"""
_GROUPS = ('MutuallyExclusiveCallbackGroup', 'ReentrantCallbackGroup')


@dataclass
class _Body:
    """A function of the program: its lines, one level in."""

    name: str
    arguments: str = ''
    is_coroutine: bool = False
    lines: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """The method as it stands in the class."""
        kind = 'async def' if self.is_coroutine else 'def'
        lines = [f'    {kind} {self.name}(self{self.arguments}):']
        lines += [f'        {line}' for line in self.lines or ['pass']]
        return '\n'.join(lines)


class _Draw:
    """One program being drawn."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.seed = seed
        self.resources: dict[str, str] = {}
        self.locks: list[str] = []
        self.clients: list[str] = []
        self.bodies: list[_Body] = []
        self.workers = 0
        self.has_loop = False

    def text(self) -> str:
        """The whole program."""
        pick = self.random
        groups = [f'group_{n}' for n in range(pick.randint(1, 3))]
        set_up = [f'self.{group} = {pick.choice(_GROUPS)}()' for group in groups]
        kinds = pick.choices(list(KINDS), k=pick.randint(1, 3))
        for number, kind in enumerate(kinds):
            self.resources[f'{kind}_{number}'] = kind
        self.locks = [f'lock_{n}' for n in range(pick.choice((0, 1, 1, 2)))]
        set_up += [f'self.{lock} = threading.Lock()' for lock in self.locks]
        if 'predicate' in kinds:
            set_up.append('self.changed = threading.Condition()')
        for name, kind in self.resources.items():
            set_up.append(f'self.{name} = {KINDS[kind].made.format(name)}')
        entities = self._entities(groups)
        self._fill()
        if self.has_loop:
            set_up += [
                'self.loop = asyncio.new_event_loop()',
                'threading.Thread(target=self.loop.run_forever, daemon=True).start()',
            ]
        set_up += entities
        bodies = '\n\n'.join(body.text for body in self.bodies)
        lines = '\n'.join(f'        {line}' for line in set_up)
        return (
            f'{_HEAD}class Waiter(Node):\n    def __init__(self):\n'
            f"        super().__init__('waiter_{self.seed}')\n{lines}\n\n{bodies}\n"
            f'{_MAIN.format(executor=self._executor())}'
        )

    def _executor(self) -> str:
        threads = self.random.choice(THREADS)
        if threads == 1:
            return 'SingleThreadedExecutor()'
        return f'MultiThreadedExecutor(num_threads={threads})'

    def _group(self, groups: list[str]) -> str:
        group = self.random.choice([*groups, ''])
        return f', callback_group=self.{group}' if group else ''

    def _entities(self, groups: list[str]) -> list[str]:
        pick, lines = self.random, []
        for number in range(pick.randint(1, 2)):
            name = f'serve_{number}'
            self.bodies.append(_Body(name, ', request, response'))
            topic = f"'waiter_{self.seed}_service_{number}'"
            lines.append(
                f'self.create_service(Trigger, {topic}, self.{name}{self._group(groups)})'
            )
            if pick.random() < 0.7:
                client = f'client_{number}'
                self.clients.append(client)
                lines.append(
                    f'self.{client} = self.create_client(Trigger, {topic}{self._group(groups)})'
                )
        topic = f"'waiter_{self.seed}_topic'"
        lines.append(f'self.publisher = self.create_publisher(Empty, {topic}, 10)')
        if pick.random() < 0.6:
            self.bodies.append(_Body('on_message', ', message'))
            lines.append(
                f'self.create_subscription(Empty, {topic}, self.on_message, 10'
                f'{self._group(groups)})'
            )
        for number in range(pick.randint(2, 3)):
            name = f'tick_{number}'
            self.bodies.append(_Body(name, is_coroutine=pick.random() < 0.3))
            period = pick.choice((0.05, 0.1, 0.15))
            lines.append(f'self.create_timer({period}, self.{name}{self._group(groups)})')
        return lines

    def _fill(self) -> None:
        for body in list(self.bodies):
            for _ in range(self.random.choice((0, 1, 1, 2))):
                body.lines += self._operation(body, nested=False)
            if body.name.startswith('tick') and self.random.random() < 0.5:
                body.lines.append('self.publisher.publish(Empty())')
            if body.name.startswith('serve'):
                body.lines.append('return response')

    def _operation(self, body: _Body, *, nested: bool) -> list[str]:
        pick = self.random
        ways = [
            self._wait,
            self._wait,
            self._wait,
            self._wake,
            self._wake,
            self._wake,
            self._pause,
        ]
        if self.locks and not nested:
            ways += [self._lock]
        if self.clients:
            ways += [self._call]
            if not body.name.startswith('work'):
                ways += [self._spin] if pick.random() < 0.2 else []
        if not nested and self.workers < 2:
            ways += [self._join, self._bridge, self._task]
        if not nested:
            ways += [self._repeat] if pick.random() < 0.3 else []
        lines = pick.choice(ways)(body)
        if pick.random() < 0.1:
            return [f'if self.count_publishers({f"waiter_{self.seed}_topic"!r}) > 0:'] + [
                f'    {line}' for line in lines
            ]
        return lines

    def _resource(self, body: _Body, *, waits: bool) -> tuple[str, str]:
        """An await needs a coroutine."""
        fit = {
            name: kind
            for name, kind in self.resources.items()
            if not (waits and KINDS[kind].in_coroutines) or body.is_coroutine
        }
        if not fit:
            return 'pause', 'pause'
        name = self.random.choice(list(fit))
        return name, fit[name]

    def _wait(self, body: _Body) -> list[str]:
        name, kind = self._resource(body, waits=True)
        if kind == 'pause':
            return self._pause(body)
        return KINDS[kind].waits.format(name).splitlines()

    def _wake(self, body: _Body) -> list[str]:
        name, kind = self._resource(body, waits=False)
        return self._pause(body) if kind == 'pause' else KINDS[kind].ends.format(name).splitlines()

    def _pause(self, body: _Body) -> list[str]:
        return ['time.sleep(0.01)']

    def _lock(self, body: _Body) -> list[str]:
        lock = self.random.choice(self.locks)
        inner = self._operation(body, nested=True)
        return [f'with self.{lock}:', *(f'    {line}' for line in inner)]

    def _call(self, body: _Body) -> list[str]:
        client = self.random.choice(self.clients)
        if body.is_coroutine:
            return [f'await self.{client}.call_async(Trigger.Request())']
        if self.random.random() < 0.15:
            return [
                f'future = self.{client}.call_async(Trigger.Request())',
                'while not future.done():',
                '    time.sleep(0.01)',
            ]
        return [f'self.{client}.call(Trigger.Request())']

    def _spin(self, body: _Body) -> list[str]:
        client = self.random.choice(self.clients)
        return [
            f'answer = self.{client}.call_async(Trigger.Request())',
            self.random.choice(
                (
                    'rclpy.spin_until_future_complete(self, answer)',
                    'self.executor.spin_until_future_complete(answer)',
                )
            ),
        ]

    def _repeat(self, body: _Body) -> list[str]:
        inner = self._operation(body, nested=True)
        return ['for _ in range(2):', *(f'    {line}' for line in inner)]

    def _work(self, *, is_coroutine: bool = False) -> _Body:
        work = _Body(f'work_{self.workers}', is_coroutine=is_coroutine)
        self.workers += 1
        self.bodies.append(work)
        for _ in range(self.random.randint(1, 2)):
            work.lines += self._operation(work, nested=True)
        return work

    def _bridge(self, body: _Body) -> list[str]:
        """A loop of asyncio on a thread of its own; its coroutines await no future of rclpy."""
        self.has_loop = True
        work = self._work()
        work.is_coroutine = True
        work.lines.insert(0, 'await asyncio.sleep(0.01)')
        return [f'asyncio.run_coroutine_threadsafe(self.{work.name}(), self.loop).result()']

    def _task(self, body: _Body) -> list[str]:
        work = self._work(is_coroutine=self.random.random() < 0.5)
        made = f'task = self.executor.create_task(self.{work.name})'
        if body.is_coroutine and self.random.random() < 0.7:
            return [made, 'await task']
        return [made, 'while not task.done():', '    time.sleep(0.01)']

    def _join(self, body: _Body) -> list[str]:
        work = self._work()
        if self.random.random() < 0.5:
            return [
                f'thread = threading.Thread(target=self.{work.name}, daemon=True)',
                'thread.start()',
                'thread.join()',
            ]
        return [
            'pool = ThreadPoolExecutor(max_workers=1)',
            f'pool.submit(self.{work.name}).result()',
        ]


def program(seed: int) -> str:
    """Draw the text of a program."""
    return _Draw(seed).text()
