"""
What a steered process is to do: read from the file that the environment names.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import json
import os
from typing import Any

VARIABLE = 'ROS2CC_LIVE_STEER'
STUBS_VARIABLE = 'ROS2CC_LIVE_STUBS'


class Point:
    """
    A statement that the order is about.

    :param file: absolute, with links resolved.
    :param first, last: its lines; of a loop with its body.
    :param column: 1-based, where the line holds more than one such place; else 0.
    :param count: how many threads are to stand there.
    :param holds: what arrives is held until all have arrived.
    :param pause_s: how long the first to arrive is held in any case.
    """

    def __init__(self, row: dict[str, Any]) -> None:
        self.file = str(row['file'])
        self.first = int(row['first'])
        self.last = int(row['last'])
        self.column = int(row.get('column', 0))
        self.count = int(row.get('count', 1))
        self.holds = bool(row.get('holds', False))
        self.pause_s = float(row.get('pause_s', 0.0))

    def contains(self, line: int) -> bool:
        return self.first <= line <= self.last


class Held:
    """
    A callback that must not begin before all points are reached.

    :param kind: `timer`, `subscription`, `service`, `client` …; empty for any.
    :param function: name of its function, with the file and the line where it is defined.
    :param key: end of the name of its topic, service or action.
    :param soft: it only has no part in the run, and may be what leads there: it is let go soon.
    """

    def __init__(self, row: dict[str, Any]) -> None:
        self.kind = str(row.get('kind', ''))
        self.function = str(row.get('function', ''))
        self.file = str(row.get('file', ''))
        self.line = int(row.get('line', 0))
        self.key = str(row.get('key', ''))
        self.soft = bool(row.get('soft', False))

    def is_of(self, entity: Any) -> bool:
        """Whether it is the callback of an entity of rclpy."""
        if self.kind and type(entity).__name__.lower() != self.kind:
            return False
        if self.function:
            function = getattr(entity, 'callback', None)
            return self._is_function(getattr(function, '__func__', function))
        return bool(self.key) and name_of(entity).endswith(f'/{self.key.lstrip("/")}')

    def _is_function(self, function: Any) -> bool:
        code = getattr(function, '__code__', None)
        if code is None or code.co_name != self.function:
            return False
        if not self.file:
            return True
        # The first line of the code is that of the first decorator.
        return os.path.realpath(code.co_filename) == self.file and (
            not self.line or code.co_firstlineno <= self.line
        )


def name_of(entity: Any) -> str:
    """Name of its topic, service or action; empty where it has none."""
    for name in ('srv_name', 'topic_name', '_action_name'):
        found = getattr(entity, name, None)
        if isinstance(found, str):
            return found if found.startswith('/') else f'/{found}'
    return ''


class Plan:
    """
    :param report: the file that events and looks are written to, one object a line.
    :param points: to be reached.
    :param held: not to begin before.
    :param surroundings: a file that is there once what the node meets outside is.
    :param race: two writes of one attribute to be forced, see ``races.py``.
    :param destroys: what the destroyer of an entity at the first point waits for: ``destroys.py``.
    :param inside: what was held is to be run inside the first point, by the spin that it is.
    :param patience_s: how long after the first arrival the rest is waited for.
    """

    def __init__(self, row: dict[str, Any]) -> None:
        self.report = str(row['report'])
        self.surroundings = str(row.get('surroundings', ''))
        self.points = [Point(each) for each in row.get('points', ())]
        self.held = [Held(each) for each in row.get('held', ())]
        self.race: dict[str, Any] | None = row.get('race')
        self.destroys = str(row.get('destroys', ''))
        self.inside = bool(row.get('inside', False))
        self.patience_s = float(row.get('patience_s', 4.0))


def read_plan(path: str) -> Plan:
    """
    Read a plan.

    :raises OSError, ValueError, KeyError: if it is invalid.
    """
    with open(path, encoding='utf-8') as stream:  # noqa: PTH123
        return Plan(json.load(stream))
