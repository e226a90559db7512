"""
Cost of the whole check on a repository: cold, warm, and after a change to one file.

``python benchmarks/repository.py [--files 1000] [--nodes 200] [--cores 1,2] [TREE…]``; without
trees on a generated one. Each figure is that of a process of its own, its start included.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

PLAIN = '''
def compute_{i}(values):
    """A function that has nothing to do with ROS."""
    total = 0
    for value in values:
        total += value * {i} if value > {i} else -value
    return total
'''
HEAD = """
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Arm{i}(Node):
    def __init__(self):
        super().__init__('arm_{i}')
        self.count = 0
        self.exclusive = MutuallyExclusiveCallbackGroup()
        self.reentrant = ReentrantCallbackGroup()
        self.publisher = self.create_publisher(String, 'out', 10)
"""
GROUPS = ('', ', callback_group=self.exclusive', ', callback_group=self.reentrant')
CREATED = {
    'timer': '        self.create_timer(0.{n}, self.on_{n}{group})\n',
    'subscription': "        self.create_subscription(String, 'in_{n}', self.on_{n}, 10{group})\n",
    'service': "        self.create_service(Trigger, 'do_{n}', self.on_{n}{group})\n",
    'client': "        self.client_{n} = self.create_client(Trigger, 'ask_{n}'{group})\n",
}
PARAMETERS = {'timer': '', 'subscription': ', msg', 'service': ', request, response'}
BODIES = (
    '        self.count += 1\n',
    '        if self.count > {n}:\n            self.publisher.publish(String())\n',
    '        time.sleep(0.{n})\n',
    "        self.get_logger().info(f'{{self.count}} of {n}')\n",
)
CALL = '        self.client_{n}.call(Trigger.Request())\n'
SPUN = {
    'one thread': '    rclpy.spin(Arm{i}())\n',
    'threads': """    executor = MultiThreadedExecutor(num_threads={threads})
    executor.add_node(Arm{i}())
    executor.spin()
""",
}
MAIN = """

def main():
    rclpy.init()
{spun}

if __name__ == '__main__':
    main()
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--files', type=int, default=1000)
    parser.add_argument('--nodes', type=int, default=200)
    parser.add_argument('--cores', default='1,2')
    parser.add_argument('trees', nargs='*', type=Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        trees = [tree.resolve() for tree in args.trees]
        if not trees:
            trees = [Path(folder) / 'generated']
            fill(trees[0], args.files, args.nodes)
        for tree in trees:
            for cores in map(int, args.cores.split(',')):
                measure(tree, cores, Path(folder) / f'cache-{tree.name}-{cores}')


def fill(tree: Path, files: int, nodes: int) -> None:
    """Make packages of ten files, the nodes spread evenly among all files."""
    rng = random.Random(1)
    for number in range(files):
        package = tree / 'src' / f'package_{number // 10}' / f'package_{number // 10}'
        if number % 10 == 0:
            package.mkdir(parents=True)
            (package / '__init__.py').write_text('')
            (package.parent / 'package.xml').write_text('<package format="3"/>\n')
        is_node = number * nodes // files != (number + 1) * nodes // files
        text = node_text(number, rng) if is_node else PLAIN.replace('{i}', str(number)) * 15
        (package / f'file_{number}.py').write_text(text)


def node_text(number: int, rng: random.Random) -> str:
    """A node of one to six callbacks; some of them block, some call a service and wait."""
    kinds = [rng.choice(['timer', 'subscription', 'service']) for _ in range(rng.randint(1, 5))]
    text = HEAD
    clients = [0] if rng.random() < 0.3 else []
    for n in clients:
        text += CREATED['client'].format(n=n, group=rng.choice(GROUPS))
    for n, kind in enumerate(kinds, start=1):
        text += CREATED[kind].format(n=n, group=rng.choice(GROUPS))
    for n, kind in enumerate(kinds, start=1):
        text += f'\n    def on_{n}(self{PARAMETERS[kind]}):\n'
        text += ''.join(body.format(n=n) for body in rng.sample(BODIES, rng.randint(1, 3)))
        if clients and n == 1:
            text += CALL.format(n=0)
        if kind == 'service':
            text += '        return response\n'
    spun = SPUN[rng.choice(list(SPUN))].format(i=number, threads=rng.randint(1, 4))
    return text.replace('{i}', str(number)) + MAIN.replace('{spun}', spun)


def measure(tree: Path, cores: int, cache: Path) -> None:
    """Time cold and warm runs and one on a changed file, and tell the memory."""
    files = sorted(tree.rglob('*.py'))
    print(f'{tree.name}, {len(files)} files, {cores} cores')
    cold = run([tree], cores, cache, tree)
    print(f'  cold              {cold}')
    print(f'  warm              {run([tree], cores, cache, tree)}')
    nodes = [file for file in files if b'rclpy.init' in file.read_bytes()]
    if nodes and tree.name == 'generated':
        changed = nodes[len(nodes) // 2]
        changed.write_text(changed.read_text().replace('self.count += 1', 'self.count += 2'))
        print(f'  one changed, tree {run([tree], cores, cache, tree)}')
        changed.write_text(changed.read_text().replace('self.count += 2', 'self.count += 3'))
        print(f'  one changed, file {run([changed], cores, cache, tree)}')


def run(paths: Sequence[Path], cores: int, cache: Path, folder: Path) -> str:
    """Check ``paths`` in a process of its own that may use so many cores."""
    program = 'import sys; from ros2cc_extract.cli.main import entry_point; entry_point()'
    command = [sys.executable, '-c', program, *(str(path) for path in paths)]
    allowed = sorted(os.sched_getaffinity(0))[:cores]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, 'XDG_CACHE_HOME': str(cache)},
        capture_output=True,
        check=False,
        text=True,
        preexec_fn=lambda: os.sched_setaffinity(0, allowed),
    )
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    told = (done.stdout.strip() or done.stderr.strip()).splitlines()[-1:]
    return (
        f'{seconds:6.2f} s, {cpu:6.2f} s of CPU, largest process {after.ru_maxrss / 1024:.0f} MB'
        f' (of all so far); exit {done.returncode}; {told[0][:120] if told else ""}'
    )


if __name__ == '__main__':
    main()
