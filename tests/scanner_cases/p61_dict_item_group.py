"""P61: groups in a dictionary, by literal keys."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.groups = {'fast': ReentrantCallbackGroup(), 'slow': MutuallyExclusiveCallbackGroup()}
        self.groups['own'] = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.tick, callback_group=self.groups['fast'])
        self.create_timer(1.0, self.tock, callback_group=self.groups['slow'])
        self.create_timer(2.0, self.tack, callback_group=self.groups['own'])
        self.create_timer(3.0, self.tuck, callback_group=self.groups.get('fast'))

    def tick(self):
        pass

    def tock(self):
        pass

    def tack(self):
        pass

    def tuck(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group fast REENTRANT
#   group slow EXCLUSIVE
#   group own EXCLUSIVE
#   timer tick in fast every 0.1
#   timer tock in slow every 1
#   timer tack in own every 2
#   timer tuck in fast every 3
