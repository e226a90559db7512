"""
Cost of the static scanner: lines per second, growth with the number of files, warm runs.

``python benchmarks/scan.py [--files 10,100,1000,10000] [TREE…]``; without trees on generated
files. Each scan runs in a process of its own.
"""

from __future__ import annotations

import argparse
import math
import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from ros2cc_extract.extract.static.api import scan

PLAIN = '''
def compute_{i}(values):
    """A function that has nothing to do with ROS."""
    total = 0
    for value in values:
        if value > {i}:
            total += value * 2
        else:
            total -= value
    return total
'''

NODE = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Arm{i}(Node):
    def __init__(self):
        super().__init__('arm_{i}')
        self.group = ReentrantCallbackGroup()
        self.count = 0
        self.limits = [0.0, 1.0, 2.0]
        self.publisher = self.create_publisher(String, 'out', 10)
        self.create_subscription(String, 'in', self.on_in, 10, callback_group=self.group)
        self.create_timer(0.1, self.tick)

    def on_in(self, msg):
        self.count += 1
        if self.count > 10:
            self.get_logger().info(f'got {msg.data}')
            self.report()

    def tick(self):
        for limit in self.limits:
            if self.count > limit:
                self.report()

    def report(self):
        out = String()
        out.data = f'{self.count} of {len(self.limits)}'
        self.publisher.publish(out)


def main(args=None):
    rclpy.init(args=args)
    node = Arm{i}()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


if __name__ == '__main__':
    main()
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--files', default='10,100,1000,10000')
    parser.add_argument('trees', nargs='*', type=Path)
    args = parser.parse_args()
    for tree in args.trees:
        print(f'{tree}: {rate(tree, timed(tree))}')
        print(f'{tree}: {shared(tree)}')
    if not args.trees:
        counts = [int(text) for text in args.files.split(',')]
        with tempfile.TemporaryDirectory() as folder:
            for kind, text in (('without rclpy', PLAIN * 20), ('nodes', NODE)):
                grow(kind, text, counts, Path(folder))
            warm(Path(folder))


def grow(kind: str, text: str, counts: list[int], folder: Path) -> None:
    points = []
    for count in counts:
        tree = folder / kind.replace(' ', '_') / str(count)
        fill(tree, text, count)
        seconds = timed(tree)
        points.append((count, seconds))
        print(f'{kind:>14} {count:>6} files: {rate(tree, seconds)}')
    if len(points) > 1:
        print(f'{kind:>14} exponent of growth: {exponent(points):.2f}')


def fill(tree: Path, text: str, count: int) -> None:
    tree.mkdir(parents=True)
    for number in range(count):
        (tree / f'file_{number}.py').write_text(text.replace('{i}', str(number)))


def warm(folder: Path) -> None:
    tree, cache = folder / 'nodes' / '1000', folder / 'cache'
    if not tree.is_dir():
        return
    print(f'1000 nodes: {shared(tree)}')
    in_child(lambda: scan([tree], cache=cache))
    seconds, wall, _ = in_child(lambda: scan([tree], cache=cache))
    print(f'warm run of 1000 unchanged files: {seconds:.2f} s of CPU, {wall:.2f} s')


def timed(tree: Path) -> tuple[float, float]:
    """Seconds of CPU on one core, which hold under load too, and MB."""
    seconds, _, megabytes = in_child(lambda: scan([tree], processes=1))
    return seconds, megabytes


def shared(tree: Path) -> str:
    """How much sooner several cores are ready; only true on an idle machine."""
    _, alone, _ = in_child(lambda: scan([tree], processes=1))
    _, together, _ = in_child(lambda: scan([tree]))
    cores = len(os.sched_getaffinity(0))
    return f'{alone:.2f} s on one core, {together:.2f} s on {cores}: {alone / together:.2f} times'


def in_child(work: Callable[[], object]) -> tuple[float, float, float]:
    """Seconds of CPU, seconds and MB of ``work`` in a fresh copy of this process."""
    start = time.perf_counter()
    child = os.fork()
    if not child:
        work()
        os._exit(0)
    _, status, usage = os.wait4(child, 0)
    if status:
        raise SystemExit(f'a scan ended with status {status}')
    wall = time.perf_counter() - start
    return usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024


def rate(tree: Path, cost: tuple[float, float]) -> str:
    seconds, megabytes = cost
    files = [tree] if tree.is_file() else list(tree.rglob('*.py'))
    lines = sum(path.read_bytes().count(b'\n') for path in files)
    told = f'{lines} lines in {seconds:.2f} s of CPU, {lines / seconds:,.0f} lines/s'
    return f'{told}, {megabytes:.0f} MB'


def exponent(points: list[tuple[int, tuple[float, float]]]) -> float:
    """Slope of time over number of files in logarithms, the smallest tree left out."""
    (n1, (t1, _)), (n2, (t2, _)) = points[min(1, len(points) - 2)], points[-1]
    return math.log(t2 / t1) / math.log(n2 / n1)


if __name__ == '__main__':
    main()
