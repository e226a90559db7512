"""
A node that is hard to enter: it allocates, imports C modules, makes and removes entities, and
keeps the interpreter in bursts. Each of these threads counts its rounds in a file that is shared.
"""

import _queue
import importlib.machinery
import importlib.util
import mmap
import shutil
import struct
import sys
import tempfile
import threading
import time
import zlib
from pathlib import Path

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import String

with Path(sys.argv[1]).open('r+b') as stream:
    ROUNDS = mmap.mmap(stream.fileno(), 0)
NUMBERS = iter(range(1000))


def repeat(work):
    """Do it again and again in a thread of its own."""
    place = 8 * next(NUMBERS)

    def run():
        for rounds in range(1 << 62):
            struct.pack_into('q', ROUNDS, place, rounds)
            work()

    threading.Thread(target=run, daemon=True).start()


def allocate():
    # Outside the interpreter's lock, in sizes that malloc asks the system for and gives back.
    for size in (1000, 200_000, 3_000_000):
        zlib.compress(bytearray(size), 1)


def load_a_module():
    with tempfile.TemporaryDirectory() as folder:
        path = shutil.copy(_queue.__file__, folder)
        loader = importlib.machinery.ExtensionFileLoader('_queue', path)
        spec = importlib.util.spec_from_loader('_queue', loader)
        importlib.util.module_from_spec(spec)
    time.sleep(0.005)


def keep_the_interpreter():
    sum(range(300_000))  # without a step of Python
    time.sleep(0.001)


rclpy.init()
node = rclpy.create_node('hot')
publisher = node.create_publisher(String, 'chatter', 10)
group = ReentrantCallbackGroup()
node.create_subscription(String, 'chatter', lambda _: None, 10, callback_group=group)
node.create_timer(0.002, lambda: publisher.publish(String(data='x')), callback_group=group)


def make_an_entity():
    made = node.create_subscription(String, 'other', lambda _: None, 10)
    node.destroy_subscription(made)


for each in (allocate, allocate, load_a_module, keep_the_interpreter, make_an_entity):
    repeat(each)
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(node)
repeat(lambda: executor.spin_once(timeout_sec=1.0))
print('hot', flush=True)
threading.Event().wait()
