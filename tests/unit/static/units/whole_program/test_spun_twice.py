"""One executor that two threads spin, as distinct from one that is spun by one after the other."""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor

def serve(node):
    rclpy.spin(node)

def serve_alone(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin()

def main():
    rclpy.init()
    one, other = rclpy.create_node('one'), rclpy.create_node('other')
    {rest}
"""
THREAD = 'thread = threading.Thread(target={name}, args=(one,))\nthread.start()\n'
EACH = """\
for node in (one, other):
    threading.Thread(target={name}, args=(node,)).start()
"""


@pytest.mark.parametrize(
    ('rest', 'lines'),
    [
        (THREAD.format(name='serve') + 'serve(other)', [7]),
        (EACH.format(name='serve'), [7]),
        (EACH.format(name='rclpy.spin'), [18]),
        (THREAD.format(name='serve') + 'thread.join()\nserve(other)', []),
        (THREAD.format(name='serve') + 'rclpy.shutdown()\nserve(other)', []),
        ('serve(one)\nserve(other)', []),
        (THREAD.format(name='serve_alone') + 'serve_alone(other)', []),
        (THREAD.format(name='serve_alone') + 'serve(other)', []),
        (EACH.format(name='serve_alone'), []),
    ],
)
def test_one_text_that_two_threads_run_for_two_nodes(rest: str, lines: list[int]) -> None:
    found = scan_text(PROGRAM.format(rest=indent(rest, '    ').lstrip())).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines
