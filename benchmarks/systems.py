"""
What a system of many nodes costs: `check` of a generated launch file, and `system` of it.

As ``python benchmarks/systems.py [NODES…] [OPTIONS OF check]``. Each node is a program of its own
with a timer, a subscription, a service and a client; each asks the next one, and every tenth pair
asks each other.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SIZES = (50, 100, 200, 400, 1000)
PAIRS_EVERY = 10
NODE = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Part{n}(Node):
    def __init__(self):
        super().__init__('part{n}')
        answers = MutuallyExclusiveCallbackGroup()
        self.next = self.create_client(Trigger, 'request{next}', callback_group=answers)
        self.create_service(Trigger, 'request{n}', self.on_request)
        self.state = self.create_publisher(String, 'state{n}', 10)
        self.create_subscription(String, 'state{next}', self.on_state, 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.state.publish(String())

    def on_state(self, message):
        pass

    def on_request(self, request, response):
        {asks}
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    node = Part{n}()
    node.next.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
"""


def generate(folder: Path, size: int) -> Path:
    """A package of ``size`` programs with a launch file of all."""
    (folder / 'package.xml').write_text('<package><name>parts</name></package>')
    (folder / 'CMakeLists.txt').write_text('install(DIRECTORY programs/ DESTINATION lib/parts)')
    (folder / 'programs').mkdir()
    (folder / 'launch').mkdir()
    for number in range(size):
        is_pair = number % PAIRS_EVERY < 2
        other = number + 1 - 2 * (number % PAIRS_EVERY) if is_pair else (number + 1) % size
        asks = 'self.next.call(Trigger.Request())' if is_pair else 'pass'
        text = NODE.format(n=number, next=other, asks=asks)
        (folder / 'programs' / f'part{number}.py').write_text(text)
    nodes = ''.join(f'<node pkg="parts" exec="part{n}.py"/>' for n in range(size))
    path = folder / 'launch' / 'all.launch.xml'
    path.write_text(f'<launch>{nodes}</launch>')
    return path


def timed(*words: str) -> tuple[float, float, str]:
    """Seconds, seconds of CPU and last line of one command."""
    begun, before = time.monotonic(), _worked()
    command = [sys.executable, '-m', 'ros2cc_extract', *words]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    last = (found.stdout.strip() or found.stderr.strip()).splitlines()[-1:]
    return time.monotonic() - begun, _worked() - before, ''.join(last)


def _worked() -> float:
    """CPU of all children, which a busy machine does not change."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    sizes = [int(word) for word in sys.argv[1:] if word.isdecimal()] or list(SIZES)
    more = [word for word in sys.argv[1:] if not word.isdecimal()]
    print('nodes  system s  CPU s  check s  CPU s  peak MB  last line of check')
    for size in sizes:
        with tempfile.TemporaryDirectory() as folder:
            path = str(generate(Path(folder), size))
            written, wrote, _ = timed('system', '--no-cache', path, '-o', f'{folder}/system.yaml')
            checked, worked, line = timed('check', '--no-cache', '-q', path, *more)
            peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024
            figures = f'{written:8.1f}  {wrote:5.1f}  {checked:7.1f}  {worked:5.1f}  {peak:7}'
            print(f'{size:5}  {figures}  {line}', flush=True)


if __name__ == '__main__':
    main()
