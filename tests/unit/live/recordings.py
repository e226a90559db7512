"""Recordings of live processes, written down by hand."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ros2cc_extract.extract.live.recorder.events import EVENT_NAMES, RAW_SUFFIX, pack
from ros2cc_extract.extract.live.recordings.recording import Recording, read_recording
from ros2cc_extract.extract.live.recordings.trace import Trace, read_trace

NOT_MEASURED = {
    'count': 0,
    'refused': 0,
    'running': 0,
    'threads': 0,
    'period': None,
    'duration': None,
}


def executor(number: int, **facts: Any) -> dict[str, Any]:
    return {
        'number': number,
        'class': 'SingleThreadedExecutor',
        'bases': ['SingleThreadedExecutor', 'Executor', 'object'],
        'own_class': False,
        'created': ['arm.py', 50, 5],
        'threads': 1,
        'default_threads': False,
        'spun': None,
        'in_thread': None,
        **facts,
    }


def stay(executor: int, since: int, until: int | None, *, waited: bool = True) -> dict[str, Any]:
    return {'executor': executor, 'since': since, 'until': until, 'waited': waited}


def node(number: int, name: str, *stays: Mapping[str, Any]) -> dict[str, Any]:
    return {'number': number, 'name': name, 'namespace': '/', 'stays': list(stays)}


def group(number: int, **facts: Any) -> dict[str, Any]:
    return {
        'number': number,
        'class': 'MutuallyExclusiveCallbackGroup',
        'kind': 'exclusive',
        'node': None,
        'default': False,
        'rate': False,
        'created': ['arm.py', 10, 9],
        **facts,
    }


def timer(number: int, node: int, group: int, function: str, **facts: Any) -> dict[str, Any]:
    return {
        'number': number,
        'kind': 'timer',
        'class': 'Timer',
        'node': node,
        'group': group,
        'key': None,
        'resolved_key': None,
        'period_s': 0.5,
        'function': {'name': function, 'defined': ['arm.py', 20, 0], 'coroutine': False},
        'execute': None,
        'builtin': False,
        'library': None,
        'late': False,
        'destroyed': False,
        'made': 1,
        'in_callback': False,
        'in_configure': False,
        'created': ['arm.py', 12, 9],
        'measured': NOT_MEASURED,
        **facts,
    }


def data(**sections: Any) -> dict[str, Any]:
    """Give what a process writes; sections left out are empty."""
    return {
        'format': 'ros2cc live recording',
        'version': 1,
        'process': {'pid': 7, 'argv': ['python', 'arm.py'], 'rclpy': '7.1.6'},
        'losses': {'count': 0, 'last': []},
        'ended': True,
        'executors': [],
        'nodes': [],
        'groups': [],
        'entities': [],
        'tasks': [],
        **sections,
    }


def recording(folder: Path, **sections: Any) -> Recording:
    path = folder / '7-1.json'
    path.write_text(json.dumps(data(**sections)), encoding='utf-8')
    return read_recording(path, folder)


def event(clock_ns: int, thread: int, what: str, subject: int) -> bytes:
    return pack(clock_ns, thread, EVENT_NAMES.index(what), subject)


def trace(recorded: Recording, *raw: bytes) -> Trace:
    """Give what is read of a raw trace of these pieces, written beside a recording."""
    Path(f'{recorded.file}{RAW_SUFFIX}').write_bytes(b''.join(raw))
    found = read_trace(recorded)
    assert found is not None
    return found
