"""Two executors: a late entity, a late node, a node that another executor takes over."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor

rclpy.init()
pool, single = MultiThreadedExecutor(3), SingleThreadedExecutor()
arm = rclpy.create_node('arm')
base = rclpy.create_node('base')
camera = rclpy.create_node('camera')
runs: list[int] = []


def make_late_timer() -> None:
    starter.cancel()
    arm.create_timer(0.01, count, callback_group=ReentrantCallbackGroup())


def count() -> None:
    runs.append(1)


starter = arm.create_timer(0.01, make_late_timer)
base.create_timer(0.01, base.get_logger)
camera.create_timer(0.01, camera.get_logger)
pool.add_node(arm)
pool.add_node(camera)
while len(runs) < 30:
    pool.spin_once(timeout_sec=1)
single.add_node(base)
single.spin_once(timeout_sec=1)
rclpy.spin_once(camera, timeout_sec=0.02)
print('camera is in its executor:', camera in pool.get_nodes())
print('arm is in its executor:', arm in pool.get_nodes())
base.destroy_node()
print('base is in its executor:', base in single.get_nodes())
# rclpy waits for no callback here, and one that is late would complain.
pool._executor.shutdown()
pool.shutdown()
rclpy.shutdown()
