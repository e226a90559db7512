"""Says tick forever; once it has ticked, none of its files may grow any more."""

import resource

import rclpy

LARGEST_FILE_BYTES = 500


def tick() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE_BYTES, resource.RLIM_INFINITY))
    print('tick', flush=True)


rclpy.init()
node = rclpy.create_node('choking')
node.create_timer(0.05, tick)
rclpy.spin(node)
