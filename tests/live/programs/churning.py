"""Makes and destroys a timer in every run of another; destroys a whole node in a callback."""

import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
node, victim = rclpy.create_node('churning'), rclpy.create_node('victim')
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(victim)
runs = []


def idle() -> None:
    pass


def tick() -> None:
    node.destroy_timer(node.create_timer(10.0, idle))
    runs.append(1)
    if len(runs) == 20:
        executor.remove_node(victim)
        victim.destroy_node()


node.create_timer(0.005, tick)
victim.create_timer(10.0, idle)
while len(runs) < 40:
    executor.spin_once()
print('runs', len(runs), 'timers', len(list(node.timers)))
rclpy.shutdown()
