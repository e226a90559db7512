"""Source trees that are large enough for the work on them to be shared."""

from __future__ import annotations

from pathlib import Path

NODES = 12
BASE = """
from rclpy.node import Node


class Base(Node):
    def listen(self):
        self.create_subscription(object, 'said', self.on_said, 10)

    def on_said(self, msg):
        self.said = msg
"""
NODE = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor

from base import Base


class Arm{i}(Base):
    def __init__(self):
        super().__init__('arm_{i}')
        self.client = self.create_client(object, 'ask')
        self.create_timer(0.{i}1, self.tick, callback_group=ReentrantCallbackGroup())
        self.create_timer(0.5, self.ask)
        self.listen()

    def tick(self):
        self.said = None

    def ask(self):
        self.client.call(None)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm{i}())
    executor.spin()


if {is_script}:
    main()
"""


def write_tree(folder: Path) -> list[Path]:
    """Two packages of nodes, half of which no entry reaches; gives the files, in order."""
    files = []
    for package in ('one', 'two'):
        (folder / package).mkdir(parents=True)
        (folder / package / 'base.py').write_text(BASE)
        files.append(folder / package / 'base.py')
        for number in range(NODES // 2):
            is_script = "__name__ == '__main__'" if number % 2 else 'False'
            text = NODE.replace('{i}', str(number)).replace('{is_script}', is_script)
            if not number % 2:
                text = text.replace('def main()', 'def unused(argument)')
            # Comments give the files the weight that makes sharing worth while.
            path = folder / package / f'arm_{number}.py'
            path.write_text(f'{text}\n' + '# padding\n' * 1_000)
            files.append(path)
    return sorted(files)
