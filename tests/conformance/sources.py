"""
Random programs as somebody would write them down: Python source, for the scanner and the hook.

One class holds nodes, groups and entities, with a method for each callback. The program feeds
itself, and is over when it has; what hangs then is ignored.
"""

from __future__ import annotations

from collections.abc import Iterator

from tests.conformance import programs
from tests.conformance.programs import Effect, Entity, Program

_HEAD = """\
import os
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.task import Future
from std_msgs.msg import Empty as Message
from std_srvs.srv import Empty as Service


class Robot:
    def __init__(self, executor):
        self.executor = executor
        self.outside = rclpy.create_node('outside', start_parameter_services=False)
"""
_MAIN = """\


def main():
    rclpy.init()
    answering = rclpy.create_node('answering', start_parameter_services=False)
    answering.create_service(Service, 'answering', lambda request, response: response)
    others = SingleThreadedExecutor()
    others.add_node(answering)
    threading.Thread(target=others.spin, daemon=True).start()
    executor = {executor}
    robot = Robot(executor)
    time.sleep(0.3)
    threading.Thread(target=executor.spin, daemon=True).start()
    for pause, number in {feeds}:
        time.sleep(pause)
        robot.feed(number)
    time.sleep(0.5)
    os._exit(0)


if __name__ == '__main__':
    main()
"""
_EXECUTORS = {
    programs.SINGLE: 'SingleThreadedExecutor()',
    programs.MULTI: 'MultiThreadedExecutor(num_threads={threads})',
}


def source_of(program: Program) -> str:
    """Write a program that runs on one of the executors written in Python."""
    executor = _EXECUTORS[program.executor].format(threads=program.threads)
    feeds = tuple(feed for feed in program.feeds if feed[1] >= 0)
    lines = [*_set_up(program), '', '    def feed(self, number):']
    for entity in program.entities:
        if entity.kind in (programs.SUBSCRIPTION, programs.GUARD, programs.SERVICE):
            lines += [f'        if number == {entity.number}:', f'            {_feed(entity)}']
    lines.append('        return None')
    for entity in program.entities:
        if entity.kind != programs.CLIENT:
            lines += _callback(program, entity)
    return _HEAD + '\n'.join(lines) + '\n' + _MAIN.format(executor=executor, feeds=feeds)


def _set_up(program: Program) -> Iterator[str]:
    for node in range(program.nodes):
        name = program.node_name(node)
        yield f"        self.n{node} = rclpy.create_node('{name}', start_parameter_services=False)"
    for number, group in enumerate(program.groups):
        cls = 'ReentrantCallbackGroup' if group.reentrant else 'MutuallyExclusiveCallbackGroup'
        yield f'        self.g{number} = {cls}()'
    for number in _wanted(program, 'wait'):
        yield f'        self.ran{number} = threading.Event()'
    for number in _wanted(program, 'await_other'):
        yield f'        self.awaited{number} = []'
    for entity in program.entities:
        yield from (f'        {line}' for line in _made(program, entity))
    for node in range(program.nodes):
        yield f'        self.executor.add_node(self.n{node})'


def _wanted(program: Program, what: str) -> list[int]:
    """Numbers of the callbacks that somebody waits for in this way."""
    effects = (effect for entity in program.entities for effect in entity.effects)
    return sorted({effect.on for effect in effects if effect.what == what})


def _made(program: Program, entity: Entity) -> Iterator[str]:
    name, node = f'self.e{entity.number}', f'self.n{entity.node}'
    callback, group = f'self.{entity.name}', f'callback_group=self.g{entity.group}'
    if entity.kind == programs.TIMER:
        yield f'{name} = {node}.create_timer({entity.period_s}, {callback}, {group})'
    elif entity.kind == programs.SUBSCRIPTION:
        yield f"self.p{entity.number} = {node}.create_publisher(Message, '{entity.key}', 20)"
        more = f"'{entity.key}', {callback}, 20, {group}"
        yield f'{name} = {node}.create_subscription(Message, {more})'
    elif entity.kind == programs.GUARD:
        yield f'{name} = {node}.create_guard_condition({callback}, {group})'
    elif entity.kind == programs.SERVICE:
        yield f"{name} = {node}.create_service(Service, '{entity.key}', {callback}, {group})"
        yield f"self.p{entity.number} = self.outside.create_client(Service, '{entity.key}')"
    elif entity.kind == programs.CLIENT:
        server = programs.server_of(program, entity)
        key = server.key if server else 'answering'
        yield f"{name} = {node}.create_client(Service, '{key}', {group})"


def _feed(entity: Entity) -> str:
    if entity.kind == programs.GUARD:
        return f'self.e{entity.number}.trigger()'
    if entity.kind == programs.SERVICE:
        return f'self.p{entity.number}.call_async(Service.Request())'
    if entity.kind == programs.SUBSCRIPTION:
        return f'self.p{entity.number}.publish(Message())'
    return 'pass'


def _callback(program: Program, entity: Entity) -> Iterator[str]:
    parameters = {programs.SUBSCRIPTION: ', message', programs.SERVICE: ', request, response'}
    awaits = any(effect.what.startswith('await') for effect in entity.effects)
    head = 'async def' if awaits else 'def'
    yield ''
    yield f'    {head} {entity.name}(self{parameters.get(entity.kind, "")}):'
    if entity.work_s:
        yield f'        time.sleep({entity.work_s})'
    if entity.spin_s:
        yield f'        until = time.monotonic() + {entity.spin_s}'
        yield '        while time.monotonic() < until:'
        yield '            pass'
    for effect in entity.effects:
        yield from (f'        {line}' for line in _effect(program, effect))
    if entity.number in _wanted(program, 'wait'):
        yield f'        self.ran{entity.number}.set()'
    if entity.number in _wanted(program, 'await_other'):
        name = f'self.awaited{entity.number}'
        yield f'        waiting, {name} = {name}, []'
        yield '        for future in waiting:'
        yield '            future.set_result(None)'
    yield f'        return {"response" if entity.kind == programs.SERVICE else None}'


def _effect(program: Program, effect: Effect) -> Iterator[str]:
    client = f'self.e{effect.on}'
    if effect.what == 'call':
        yield f'{client}.call(Service.Request())'
    elif effect.what == 'await_call':
        yield f'await {client}.call_async(Service.Request())'
    elif effect.what == 'spin_call':
        yield f'asked = {client}.call_async(Service.Request())'
        yield 'self.executor.spin_until_future_complete(asked, timeout_sec=0.5)'
    elif effect.what == 'wait':
        yield f'self.ran{effect.on}.wait()'
    elif effect.what == 'await_other':
        yield 'future = Future()'
        yield f'self.awaited{effect.on}.append(future)'
        yield 'await future'
    elif effect.what == 'make_task':
        yield f'self.executor.create_task(self.c{effect.on})'
    elif effect.what == 'publish':
        yield _feed(program.entities[effect.on])
