"""
Random systems of two to four processes that ask each other.

A process is one node on one executor, with services, timers, clients, locks and groups of its own.
Before it is spun it waits until all that it asks is there. Equal seeds give equal texts.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path

THREADS = (1, 2, 2, 3, 4, 5)
_GROUPS = (
    'MutuallyExclusiveCallbackGroup',
    'MutuallyExclusiveCallbackGroup',
    'ReentrantCallbackGroup',
)
_HEAD = """\
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


"""
_MAIN = """\


def main():
    rclpy.init()
    node = Part()
    for client in node.asked:
        client.wait_for_service()
    executor = {executor}
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
"""


@dataclass
class _Part:
    """A process being drawn: ``clients`` by the service that each of them asks."""

    number: int
    groups: list[str]
    services: list[str]
    is_pool: bool
    clients: dict[str, str] = field(default_factory=dict)


class _Draw:
    """One system being drawn."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.asks = self.random.choice((0.3, 0.5, 0.8))

    def texts(self) -> dict[str, str]:
        """The programs by their names."""
        pick = self.random
        parts = [
            _Part(
                number,
                [f'group_{n}' for n in range(pick.randint(1, 4))],
                [f'serve_{number}_{n}' for n in range(pick.choice((0, 1, 1, 2)))],
                pick.random() < 0.85,
            )
            for number in range(pick.choice((2, 2, 3, 3, 4)))
        ]
        if not any(part.services for part in parts):
            parts[-1].services.append(f'serve_{parts[-1].number}_0')
        return {f'part_{part.number}': self._text(part, parts) for part in parts}

    def _text(self, part: _Part, parts: list[_Part]) -> str:
        pick = self.random
        bodies = [self._body(f'{name}(self, request, response)', part, parts, 'return response')
                  for name in part.services]  # fmt: skip
        ticks = [f'tick_{n}' for n in range(pick.choice((0, 1, 1, 2)) or not part.services)]
        bodies += [self._body(f'{name}(self)', part, parts) for name in ticks]
        lines = [f"super().__init__('part_{part.number}')", 'self.lock = threading.Lock()']
        lines += [f'self.{group} = {pick.choice(_GROUPS)}()' for group in part.groups]
        lines += [
            f"self.create_service(Trigger, '{name}', self.{name}{self._group(part)})"
            for name in part.services
        ]
        for service, client in part.clients.items():
            group = self._group(part)
            lines.append(f"self.{client} = self.create_client(Trigger, '{service}'{group})")
        for name in ticks:
            period = pick.choice((0.1, 0.15, 0.2))
            lines.append(f'self.create_timer({period}, self.{name}{self._group(part)})')
        lines.append(f'self.asked = [{", ".join(f"self.{c}" for c in part.clients.values())}]')
        set_up = '\n'.join(f'        {line}' for line in lines)
        threads = pick.choice(THREADS)
        executor = (
            f'MultiThreadedExecutor(num_threads={threads})'
            if part.is_pool and threads > 1
            else 'SingleThreadedExecutor()'
        )
        methods = '\n\n'.join(bodies)
        return (
            f'{_HEAD}class Part(Node):\n    def __init__(self):\n{set_up}\n\n{methods}\n'
            f'{_MAIN.format(executor=executor)}'
        )

    def _group(self, part: _Part) -> str:
        group = self.random.choice([*part.groups, ''])
        return f', callback_group=self.{group}' if group else ''

    def _body(self, head: str, part: _Part, parts: list[_Part], end: str = '') -> str:
        lines: list[str] = []
        for _ in range(self.random.choice((0, 1, 1, 1, 2))):
            lines += self._operation(part, parts)
        lines += [end] if end else []
        text = '\n'.join(f'        {line}' for line in lines or ['pass'])
        return f'    def {head}:\n{text}'

    def _operation(self, part: _Part, parts: list[_Part]) -> list[str]:
        pick = self.random
        is_call = pick.random() < self.asks
        call = self._call(part, parts) if is_call else ['time.sleep(0.01)']
        if pick.random() < 0.15:
            return ['with self.lock:', *(f'    {line}' for line in call)]
        return call

    def _call(self, part: _Part, parts: list[_Part]) -> list[str]:
        pick = self.random
        others = [name for each in parts if each is not part for name in each.services]
        names = part.services if not others or pick.random() < 0.04 else others
        if not names:
            return ['time.sleep(0.01)']
        client = part.clients.setdefault(name := pick.choice(names), f'ask_{name}')
        way = pick.random()
        if way < 0.12:
            return [f'self.{client}.call(Trigger.Request(), timeout_sec=0.5)']
        if way < 0.24:
            return [
                'answered = threading.Event()',
                f'future = self.{client}.call_async(Trigger.Request())',
                'future.add_done_callback(lambda _: answered.set())',
                f'answered.wait({pick.choice(("", "0.5"))})',
            ]
        if way < 0.3:
            return [f'self.{client}.call_async(Trigger.Request())']
        return [f'self.{client}.call(Trigger.Request())']


def programs(seed: int) -> dict[str, str]:
    """Draw the programs of a system."""
    return _Draw(seed).texts()


def write(seed: int, folder: Path) -> Path:
    """Write a system as a package; its launch file."""
    texts = programs(seed)
    (folder / 'programs').mkdir(parents=True)
    (folder / 'launch').mkdir()
    (folder / 'package.xml').write_text('<package><name>drawn</name></package>', encoding='utf-8')
    lists = 'install(DIRECTORY programs/ DESTINATION lib/drawn)\n'
    (folder / 'CMakeLists.txt').write_text(lists, encoding='utf-8')
    for name, text in texts.items():
        (folder / 'programs' / f'{name}.py').write_text(text, encoding='utf-8')
    nodes = ''.join(f'<node pkg="drawn" exec="{name}.py"/>' for name in texts)
    path = folder / 'launch' / 'all.launch.xml'
    path.write_text(f'<launch>{nodes}</launch>', encoding='utf-8')
    return path
