"""
Runs a program of ``AsyncNode`` and writes what its callbacks did, as a trace.

``python loop_tracer.py PROGRAM TRACE``. Begins and ends of callbacks are reported, and each await
of it to suspend and to go on; a client, to take an answer. The standard library and rclpy alone.
"""

from __future__ import annotations

import atexit
import inspect
import json
import runpy
import sys
import time
from pathlib import Path

from rclpy.experimental import async_client, async_node, async_timer

PROCESS, EXECUTOR, THREAD = 1, 0, 1
KINDS = {
    'create_timer': 'timer',
    'create_subscription': 'subscription',
    'create_service': 'service',
    'create_client': 'client',
}
subjects = [
    {'kind': 'executor', 'name': 'AsyncNode', 'node': None, 'group': None, 'executor': None}
]
events = []
number_of = {}
# What a node cancels at its end is no step of its callbacks.
over = []


def note(name, number):
    if not over:
        events.append((time.monotonic_ns(), name, number))


class Steps:
    """A coroutine that reports each suspension."""

    def __init__(self, coroutine, number):
        self.coroutine, self.number = coroutine, number

    def __await__(self):
        given, error = None, None
        while True:
            try:
                waiting = self.coroutine.throw(error) if error else self.coroutine.send(given)
            except StopIteration as end:
                return end.value
            note('suspend', self.number)
            given, error = None, None
            try:
                given = yield waiting
            except BaseException as raised:
                error = raised
            note('resume', self.number)


def traced(callback, number):
    async def run(*args):
        note('begin', number)
        try:
            result = callback(*args)
            return await Steps(result, number) if inspect.isawaitable(result) else result
        finally:
            note('end', number)

    return run


def creating(original, kind):
    def create(node, *args, **keywords):
        number = len(subjects)
        found = [arg for arg in args if callable(arg) and not isinstance(arg, type)]
        callback = found[0] if found else None
        args = [traced(arg, number) if arg is callback and found else arg for arg in args]
        entity = original(node, *args, **keywords)
        number_of[id(entity)] = number
        key = None if kind == 'timer' else args[1]
        subjects.append(
            {
                'kind': kind,
                'name': callback.__qualname__ if callback else key,
                'node': node.get_name(),
                'group': number,
                'executor': EXECUTOR,
                'key': key,
            }
        )
        return entity

    return create


def responding(original):
    async def responses(client):
        number = number_of[id(client)]
        async for each in original(client):
            note('begin', number)
            yield each
            note('end', number)

    return responses


def ending(original):
    def destroy(node):
        over.append(node)
        original(node)

    return destroy


def write(path):
    lines = [
        {
            'format': 'ros2cc trace',
            'version': 1,
            'process': PROCESS,
            'rclpy': None,
            'lost': 0,
            'threads': {str(THREAD): 'loop'},
        }
    ]
    lines += [
        {'process': PROCESS, 'entity': number, 'key': None, **subject}
        for number, subject in enumerate(subjects)
    ]
    lines += [
        {'process': PROCESS, 'clock_ns': at, 'thread': THREAD, 'event': name, 'entity': number}
        for at, name, number in events
    ]
    Path(path).write_text(''.join(json.dumps(line) + '\n' for line in lines))


def main():
    program, path = sys.argv[1:]
    for name, kind in KINDS.items():
        original = getattr(async_node.AsyncNode, name)
        setattr(async_node.AsyncNode, name, creating(original, kind))
    # What a timer looks at is the number of arguments of its callback.
    async_timer.AsyncTimer._detect_wants_info = staticmethod(lambda callback: False)
    async_node.AsyncNode.destroy_node = ending(async_node.AsyncNode.destroy_node)
    client = async_client.AsyncClient
    client._responses = responding(client._responses)
    atexit.register(write, path)
    runpy.run_path(program, run_name='__main__')


if __name__ == '__main__':
    main()
