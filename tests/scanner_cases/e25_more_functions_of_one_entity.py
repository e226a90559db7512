"""EffectLog: what several functions do that one subscription runs, of filters and parameter events."""
# live: no, the subscriptions are of libraries

import message_filters
import rclpy
from rclpy.node import Node
from rclpy.parameter_event_handler import ParameterEventHandler
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.seen = self.kept = self.gain = self.limit = 0
        self.input = message_filters.Subscriber(self, String, 'in')
        self.input.registerCallback(self.look)
        self.input.registerCallback(self.keep)
        self.handler = ParameterEventHandler(self)
        self.handler.add_parameter_callback('gain', 'a', self.on_gain)
        self.handler.add_parameter_callback('limit', 'a', self.on_limit)

    def look(self, msg):
        self.seen = 1

    def keep(self, msg):
        self.kept = 1

    def on_gain(self, parameter):
        self.gain = 1

    def on_limit(self, parameter):
        self.limit = 1


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription look in a_default key=in library=message_filters
#     writes A.seen @23
#     writes A.kept @26
#   subscription on_gain in a_default key=/parameter_events library=rclpy.ParameterEventHandler
#     writes A.gain @29
#     writes A.limit @32
