"""
The load of ``hook.py``: a 1 kHz timer that publishes, and a subscription to what it publishes.

Arguments: single or multi, seconds. Prints one line of JSON about itself. Needs rclpy only.
"""

import json
import os
import resource
import statistics
import sys
import threading
import time
from collections import deque

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import Executor, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int64

PERIOD_S = 0.001
WARM_UP_S = 2.0
LATENCIES_KEPT = 10_000


class Load(Node):
    """Notes how late each message arrives."""

    def __init__(self) -> None:
        super().__init__('load')
        self.received = 0
        self.latencies_ns: deque[int] = deque(maxlen=LATENCIES_KEPT)
        self.publisher = self.create_publisher(Int64, 'clock_ns', 10)
        self.create_subscription(
            Int64,
            'clock_ns',
            self.on_message,
            10,
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        self.create_timer(PERIOD_S, self.on_timer)

    def on_timer(self) -> None:
        self.publisher.publish(Int64(data=time.monotonic_ns()))

    def on_message(self, message: Int64) -> None:
        self.received += 1
        self.latencies_ns.append(time.monotonic_ns() - message.data)


def cpu_s() -> float:
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def keep_to_one_core() -> None:
    """
    Run on one core: on two, the spinning thread of a pool takes the interpreter from the workers.

    Of 2000 callbacks a second a dozen were left on an idle machine, with and without the hook.
    """
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def executor_for(kind: str) -> Executor:
    return SingleThreadedExecutor() if kind == 'single' else MultiThreadedExecutor(2)


def main() -> None:
    kind, seconds = sys.argv[1], float(sys.argv[2])
    keep_to_one_core()
    rclpy.init()
    node = Load()
    executor = executor_for(kind)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    time.sleep(WARM_UP_S)
    received, cpu, begun = node.received, cpu_s(), time.monotonic()
    node.latencies_ns.clear()
    time.sleep(seconds)
    result = {
        'callbacks_per_s': 2 * (node.received - received) / (time.monotonic() - begun),
        'cpu_us_per_callback': (cpu_s() - cpu) / (2 * (node.received - received)) * 1e6,
        'latency_median_us': statistics.median(node.latencies_ns) / 1e3,
        'latency_p99_us': sorted(node.latencies_ns)[len(node.latencies_ns) * 99 // 100] / 1e3,
    }
    print(json.dumps(result), flush=True)
    os._exit(0)


if __name__ == '__main__':
    main()
