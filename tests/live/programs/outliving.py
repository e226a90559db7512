"""A callback shuts rclpy down; threads of the program live on, one of them forever."""

import contextlib
import threading

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor

main_is_over = threading.Event()


def outlive() -> None:
    main_is_over.wait()
    print('outlived')


def tick() -> None:
    print('shutting down')
    rclpy.shutdown()


def spin() -> None:
    # How rclpy reports it depends on where the executor is when its context goes away.
    with contextlib.suppress(ExternalShutdownException, RCLError):
        executor.spin()


rclpy.init()
node = rclpy.create_node('leaving')
node.create_timer(0.01, tick)
executor = MultiThreadedExecutor(2)
executor.add_node(node)
spinning = threading.Thread(target=spin)
spinning.start()
threading.Thread(target=outlive).start()
threading.Thread(target=threading.Event().wait, daemon=True).start()
spinning.join()
print('nodes', len(executor.get_nodes()) <= 1)
node.destroy_node()
main_is_over.set()
