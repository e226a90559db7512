"""
Records a process that was started without the hook: once, from inside, wrapping nothing.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import gc
import sys
from typing import Any

from ..recorder.frames import is_node
from ..recorder.record import Recorder
from ..recorder.snapshot import snapshot
from ..recorder.spinning import look_for_spinning_threads


def record_process(path: str) -> None:
    """Write what the executors of this process hold into a new file."""
    recorder = Recorder()
    executors = sys.modules.get('rclpy.executors')
    nodes = []
    if executors is not None:
        for candidate in gc.get_objects():
            kind = type(candidate)
            if issubclass(kind, executors.Executor):
                recorder.note_executor(candidate)
            elif is_node(candidate):
                nodes.append(candidate)
    for node in nodes:
        _note_node(recorder, node)
    recorder.look_around()
    recorder.settle()
    look_for_spinning_threads(recorder)
    with open(path, 'x', encoding='utf-8') as stream:  # noqa: PTH123
        stream.write(snapshot(recorder, ended=False))


def _note_node(recorder: Recorder, node: Any) -> None:
    recorder.note_node(node)
    # An executor keeps serving its nodes when another has taken one of them over and let it go.
    owners = [record.ref() for record in recorder.all_executors]
    if node.executor is not None and node.executor not in owners:
        owners.append(node.executor)
    for executor in owners:
        if executor is not None and node in executor.get_nodes():
            recorder.note_added(executor, node)
