"""P43: a life-cycle node: made in on_configure, after the transition."""
# live: no, on_configure does not run at start

import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class A(LifecycleNode):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    def on_configure(self, state):
        self.sub = self.create_subscription(String, 'in', self.on_in, 10)
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state):
        self.destroy_subscription(self.sub)
        return TransitionCallbackReturn.SUCCESS

    def on_in(self, msg):
        pass

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
#   timer tick in a_default every 1
#   subscription on_in in a_default key=in when=configure
#   lifecycle_service on_configure in a_default
#     writes A.sub @15
#     changes subscription @15
#   lifecycle_service on_cleanup in a_default
#     reads A.sub @19
