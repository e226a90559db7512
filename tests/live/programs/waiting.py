"""Says tick until somebody ends it; as many nodes and timers as asked for."""

import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor

nodes, timers = (int(argument) for argument in sys.argv[1:])
rclpy.init()
executor = SingleThreadedExecutor()
made = []
for number in range(nodes):
    node = rclpy.create_node(f'node_{number}')
    made.append(node)
    for _ in range(timers):
        node.create_timer(60.0, lambda: None)
    executor.add_node(node)
made[0].create_timer(0.05, lambda: print('tick', flush=True))
executor.spin()
