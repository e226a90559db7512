"""CC107: threads that spin one executor meet, processes have one each."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import multiprocessing
import threading
import rclpy
from rclpy.node import Node


def run(name):
    rclpy.init()
    rclpy.spin(Node(name))


def both(name):
    rclpy.init()
    threading.Thread(target=rclpy.spin, args=(Node(name),)).start()
    rclpy.spin(Node('second'))


def main():
    {start}


main()
"""
TWO = "{0}(target=run, args=('a',)).start()\n    {0}(target=run, args=('b',)).start()"
EACH = "for name in ('a', 'b'):\n        {0}(target=run, args=(name,)).start()"
PROCESS, THREAD = 'multiprocessing.Process', 'threading.Thread'


@pytest.mark.parametrize(
    ('start', 'meet'),
    [
        (TWO.format(PROCESS), False),
        (EACH.format(PROCESS), False),
        (TWO.format(THREAD), True),
        (EACH.format(THREAD), True),
        (f"{PROCESS}(target=both, args=('a',)).start()", True),
    ],
)
def test_only_threads_of_one_process_meet(start: str, meet: bool) -> None:
    told = scan_text(PROGRAM.format(start=start)).diagnostics
    assert any('another thread' in each.message for each in told) is meet
