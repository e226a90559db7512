"""Point 20: what the program destroys is present and marked."""
# live: no, destroyed entities are gone

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.sub = self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(5.0, self.stop)
        self.old = self.create_timer(1.0, self.tick)
        self.destroy_timer(self.old)

    def on_in(self, msg):
        pass

    def stop(self):
        self.destroy_subscription(self.sub)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer stop in a_default every 5
#   timer tick in a_default every 1 destroyed
#   subscription on_in in a_default key=in destroyed
