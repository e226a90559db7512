"""P15: spun only until an answer comes."""

import rclpy
from std_srvs.srv import Trigger


def main():
    rclpy.init()
    node = rclpy.create_node('asker')
    client = node.create_client(Trigger, 'go')
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    node.get_logger().info(str(future.result()))


if __name__ == '__main__':
    main()

# expect:
# unit asker: SingleThreadedExecutor x1 rclpy.spin_until_future_complete, main
#   group asker_default EXCLUSIVE default
#   client go_client in asker_default key=go
