"""Small nodes of one pattern: who waits, and who ends the wait in its group or in another one."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent, indent

from tests.shapes.told import Told, told

_NODE = """\
import concurrent.futures
import queue
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
{init}

{methods}

    def serve(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Waiter())
    executor.spin()


if __name__ == '__main__':
    main()
"""


def node(init: str, methods: str) -> str:
    """The text of a node with the set-up ``init`` and these methods."""
    parts = {'init': indent(dedent(init).strip(), ' ' * 8)}
    return _NODE.format(**parts, methods=indent(dedent(methods).strip(), ' ' * 4))


def told_of(text: str, folder: Path) -> Told:
    """What a check says of a node."""
    path = folder / 'node.py'
    path.write_text(text, encoding='utf-8')
    return told(path)


def said_of_waits(text: str, folder: Path) -> str:
    """The codes of what was found, else how waits were left open, else *clean*."""
    said = told_of(text, folder)
    codes = [code for code, _ in said.findings]
    return ','.join(sorted(set(codes or [way for way, _ in said.open_waits]))) or 'clean'
