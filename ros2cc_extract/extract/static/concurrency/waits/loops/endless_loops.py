"""
Callbacks that never end: ``while True:`` and ``while rclpy.ok():`` without a way out.

Whatever its rounds wait for, such a callback keeps its thread, and its group, until the program
ends.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import leaves
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import is_endless
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable, used_names
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import ENDLESS_LOOP

_END = DataRef('the end of the program')
_ENDING = frozenset(
    ['shutdown', 'try_shutdown', 'exit', '_exit', 'abort', 'throw', 'interrupt_main']
)
"""Calls by which its rounds may end it: of rclpy, ``sys``, ``os``, ``_thread``."""


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Note a loop that nothing ends, behind what its rounds wait for; whether it is one."""
    world = machine.world
    if not world.in_callback or not is_endless(loop) or leaves(loop):
        return False
    place = frame.place(loop)
    texts = reachable(world, loop)
    end: DataRef | Unknown = _END
    if world.caught:
        end = Unknown('only an exception or the end of the program ends it', place)
    elif any(not _ENDING.isdisjoint(used_names(text)) for text in texts):
        end = Unknown('code that its rounds may call ends the program', place)
    machine.note_loop_on_data(ENDLESS_LOOP, end, None, place)
    return True
