"""
The table of all waits that the scanner knows: those of rclpy beside those of Python.

Source: rclpy 7.1.6, ``client.py``, ``timer.py``, ``task.py``, ``clock.py``.
"""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine import wait_table
from ros2cc_extract.extract.static.concurrency.machine.wait_table import OF_OUTSIDE, SLEEP, WaitRow
from ros2cc_extract.extract.static.python.machine.path_facts import Word

_ANSWER = WaitRow(frozenset({Word.END}))

WAITS: dict[str, WaitRow] = {
    **wait_table.WAITS,
    'Clock.sleep_for': SLEEP,
    'Clock.sleep_until': SLEEP,
    'wait_for_message': WaitRow(),
    'client.call': replace(_ANSWER, raises=TimeoutError),
    'send_goal': _ANSWER,
    'get_result': _ANSWER,
    'cancel_goal': _ANSWER,
    'Rate.sleep': _ANSWER,
    'wait_for_service': OF_OUTSIDE,
    'wait_for_server': OF_OUTSIDE,
}
