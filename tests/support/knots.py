"""Nodes whose callbacks wait for each other in a circle: each takes the checker seconds."""

from __future__ import annotations

from pathlib import Path

_NODE = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Knot(Node):
    def __init__(self):
        super().__init__('knot')
{made}

{methods}

def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads={threads})
    executor.add_node(Knot())
    executor.spin()
"""


def knot(callers: int) -> str:
    """Each caller is in a group of its own; its client is in that of the next."""
    made = [f'        g{n} = MutuallyExclusiveCallbackGroup()' for n in range(callers)]
    methods = []
    for n in range(callers):
        of_own, of_next = f'callback_group=g{n}', f'callback_group=g{(n + 1) % callers}'
        made += [
            f"        self.client{n} = self.create_client(Trigger, 'plan{n}', {of_next})",
            f'        self.create_subscription(String, "t{n}", self.on{n}, 1, {of_own})',
        ]
        methods += [
            f'    def on{n}(self, message):',
            f'        self.client{n}.call(Trigger.Request())',
            '',
        ]
    return _NODE.format(made='\n'.join(made), methods='\n'.join(methods), threads=callers + 1)


def write_knots(folder: Path, number: int, callers: int = 6) -> None:
    """Write so many nodes, each in a file of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    for n in range(number):
        (folder / f'knot{n}.py').write_text(knot(callers), encoding='utf-8')
