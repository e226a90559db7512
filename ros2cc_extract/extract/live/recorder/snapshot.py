"""
The recorder's contents as text: one JSON object.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. ``recording.py`` reads what is written here.
"""

from __future__ import annotations

import functools
import json
import os
import sys
import time
from collections.abc import Iterable
from typing import Any

from .entries import EntityRecord, ExecutorRecord, GroupRecord, NodeRecord, TaskRecord
from .frames import Creation, FunctionName
from .record import Recorder

FORMAT = 'ros2cc live recording'
VERSION = 1
_RCLPY_PACKAGES = ('ros-rclpy', 'rclpy')


def snapshot(recorder: Recorder, *, ended: bool) -> str:
    """
    Write everything as JSON, in small pieces.

    One piece for each record: a single call for all would keep every other thread of the
    program waiting.
    """
    sections = (
        ('executors', map(json.dumps, map(_executor, recorder.all_executors))),
        ('nodes', map(json.dumps, map(_node, recorder.all_nodes))),
        ('groups', map(json.dumps, map(_group, recorder.all_groups))),
        ('entities', map(_entity_text, recorder.all_entities)),
        ('tasks', map(json.dumps, map(_task, list(recorder.tasks.values())))),
    )
    head = json.dumps({**_head(recorder), 'ended': ended})[:-1]
    return head + ''.join(_section(name, rows) for name, rows in sections) + '\n}\n'


def _section(name: str, rows: Iterable[str]) -> str:
    return f',\n"{name}": [' + ',\n'.join(rows) + ']'


def _entity_text(record: EntityRecord) -> str:
    """Write an entity anew only if something has changed: of thousands, few run at a time."""
    state = record.state()
    if record.text is None or record.text[0] != state:
        record.text = state, json.dumps(_entity(record))
    return record.text[1]


def _head(recorder: Recorder) -> dict[str, Any]:
    return {
        'format': FORMAT,
        'version': VERSION,
        'process': {
            'pid': os.getpid(),
            'argv': list(getattr(sys, 'orig_argv', sys.argv)),
            'python': sys.version.split()[0],
            'rclpy': _rclpy_version(),
            'cwd': _cwd(),
            'main': getattr(sys.modules.get('__main__'), '__file__', None),
        },
        'written_s': time.time(),
        'losses': {'count': recorder.loss_count, 'last': list(recorder.losses)},
    }


@functools.cache
def _rclpy_version() -> str | None:
    """Ask once: the answer takes a walk over all that is installed."""
    from importlib import metadata

    for package in _RCLPY_PACKAGES:
        try:
            return metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    return None


def _cwd() -> str | None:
    try:
        return os.getcwd()  # noqa: PTH109 - pathlib is not worth its import here
    except FileNotFoundError:
        return None


def _executor(record: ExecutorRecord) -> dict[str, Any]:
    return {
        'number': record.number,
        'class': record.cls,
        'bases': record.bases,
        'own_class': record.own_class,
        'created': record.created,
        'threads': record.threads,
        'default_threads': record.default_threads,
        'spun': record.spun,
        'in_thread': record.in_thread,
    }


def _node(record: NodeRecord) -> dict[str, Any]:
    return {
        'number': record.number,
        'name': record.name,
        'namespace': record.namespace,
        'class': record.cls,
        'called': [
            {'kind': kind, 'function': _function(function), 'group': group}
            for kind, function, group in record.called
        ],
        'publishers': [each.describe() for each in record.publishers.values()],
        'stays': [
            {
                'executor': stay.executor,
                'since': stay.since,
                'until': stay.until,
                'waited': stay.waited,
            }
            for stay in record.stays
        ],
    }


def _group(record: GroupRecord) -> dict[str, Any]:
    return {
        'number': record.number,
        'class': record.cls,
        'kind': record.kind,
        'node': record.node,
        'default': record.default,
        'rate': record.rate,
        **_creation(record.creation),
    }


def _entity(record: EntityRecord) -> dict[str, Any]:
    return {
        'number': record.number,
        'kind': record.kind,
        'class': record.cls,
        'node': record.node,
        'group': record.group,
        'key': record.key,
        'resolved_key': record.resolved_key,
        'type': record.type,
        'qos': record.qos,
        'period_s': None if record.period_ns is None else record.period_ns / 1e9,
        'function': _function(record.function),
        'execute': _function(record.execute),
        'builtin': record.builtin,
        'library': record.library,
        'late': record.late,
        'destroyed': record.destroyed,
        'made': record.made,
        'measured': record.timings.describe(),
        **_creation(record.creation),
    }


def _task(record: TaskRecord) -> dict[str, Any]:
    return {
        'number': record.number,
        'kind': record.kind,
        'executor': record.executor,
        'node': record.node,
        'function': _function(record.function),
        'count': record.count,
    }


def _creation(creation: Creation | None) -> dict[str, Any]:
    if creation is None:
        return {'created': None, 'in_callback': False, 'in_configure': False}
    return {
        'created': creation.place,
        'in_callback': creation.in_callback,
        'in_configure': creation.in_configure,
    }


def _function(function: FunctionName | None) -> dict[str, Any] | None:
    if function is None:
        return None
    return {
        'name': function.name,
        'defined': function.defined,
        'coroutine': function.coroutine,
    }
