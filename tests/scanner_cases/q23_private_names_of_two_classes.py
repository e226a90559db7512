"""Point 23: a private name belongs to the class in whose text it stands."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Base(Node):
    def __init__(self):
        super().__init__('a')
        self.__busy = False
        self.create_subscription(String, 'base', self.__on_message, 10)
        self.create_timer(1.0, lambda: self.__tick())

    def __on_message(self, msg):
        self.__busy = True

    def __tick(self):
        self.__busy = False


class Sub(Base):
    def __init__(self):
        super().__init__()
        self.__busy = 0
        self.create_subscription(String, 'sub', self.__on_message, 10)

    def __on_message(self, msg):
        self.__busy += 1


def main():
    rclpy.init()
    rclpy.spin(Sub())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer lambda___tick in a_default (Base.__init__.<locals>.<lambda>) every 1
#     writes Sub._Base__busy @13>19
#   subscription base___on_message in a_default (Base.__on_message) key=base
#     writes Sub._Base__busy @16
#   subscription sub___on_message in a_default (Sub.__on_message) key=sub
#     writes Sub.__busy update @29
