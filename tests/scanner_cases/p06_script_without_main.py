"""P6: set-up at module level."""

import rclpy


rclpy.init()
node = rclpy.create_node('a')


def tick():
    pass


node.create_timer(0.5, tick)
if __name__ == '__main__':
    rclpy.spin(node)

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, __main__
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
