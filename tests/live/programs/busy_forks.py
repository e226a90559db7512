"""Starts processes that know nothing of rclpy while an executor spins."""

import multiprocessing
import subprocess
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
node = rclpy.create_node('busy')
ticked = threading.Event()
node.create_timer(0.001, ticked.set)
executor = SingleThreadedExecutor()
executor.add_node(node)
spinning = threading.Thread(target=executor.spin, daemon=True)
spinning.start()
for number in range(5):
    ticked.wait()
    child = multiprocessing.get_context('fork').Process(target=print, args=(number,), daemon=True)
    child.start()
    child.join()
    print('forked', child.exitcode, 'called', subprocess.run(['false'], check=False).returncode)
    ticked.clear()
executor.shutdown()
spinning.join()
node.destroy_node()
rclpy.shutdown()
