"""
Cost of the static scanner: lines per second, growth with the number of files, warm runs.

``python benchmarks/scan.py [--files 10,100,1000] [TREE…]``; without trees on generated files.
"""

from __future__ import annotations

import argparse
import math
import tempfile
import time
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
    parser.add_argument('--files', default='10,100,1000')
    parser.add_argument('trees', nargs='*', type=Path)
    args = parser.parse_args()
    for tree in args.trees:
        print(f'{tree}: {described(tree)}')
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
    scan([tree], cache=cache)
    start = time.perf_counter()
    scan([tree], cache=cache)
    print(f'warm run of 1000 unchanged files: {time.perf_counter() - start:.2f} s')


def described(tree: Path) -> str:
    return rate(tree, timed(tree))


def timed(tree: Path) -> float:
    start = time.process_time()
    scan([tree])
    return time.process_time() - start


def rate(tree: Path, seconds: float) -> str:
    files = [tree] if tree.is_file() else list(tree.rglob('*.py'))
    lines = sum(path.read_bytes().count(b'\n') for path in files)
    return f'{lines} lines in {seconds:.2f} s of CPU, {lines / seconds:,.0f} lines/s'


def exponent(points: list[tuple[int, float]]) -> float:
    """Slope between the two largest points, in logarithms."""
    (n1, t1), (n2, t2) = points[-2:]
    return math.log(t2 / t1) / math.log(n2 / n1)


if __name__ == '__main__':
    main()
