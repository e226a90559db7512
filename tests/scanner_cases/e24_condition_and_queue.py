"""EffectLog: conditions and queues; who notifies and who puts, and a queue that is asked first."""

import queue
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.filled = threading.Condition()
        self.orders = queue.Queue()
        self.narrow = queue.Queue(maxsize=1)
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_service(Trigger, 'take', self.take)
        self.create_timer(1.0, self.look)

    def on_in(self, msg):
        with self.filled:
            self.filled.notify_all()
        if msg.data:
            self.orders.put(msg)
        self.narrow.put(msg)

    def take(self, request, response):
        with self.filled:
            self.filled.wait()
        self.orders.get()
        self.orders.get(timeout=0.5)
        self.orders.get(block=False)
        return response

    def look(self):
        while not self.narrow.empty():
            self.narrow.get()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer look in a_default every 1
#     reads narrow @38
#     writes narrow update in_place rests @39
#   subscription on_in in a_default key=in
#     blocks Queue.put on narrow through narrow (room) each initial=1 @27
#       ended by look @39
#       ended by ?
#     writes orders update in_place @26
#     writes narrow update in_place @27
#     locks filled @23
#   service take in a_default key=take
#     blocks Condition.wait on on_in through filled each forgets @31
#       ended by on_in @24
#     blocks Queue.get on on_in through orders each @32
#       ended by on_in conditional @26
#     blocks Queue.get on on_in through orders each 0.5 s @33
#       ended by on_in conditional @26
#     writes orders update in_place @32
#     writes orders update in_place @33
#     writes orders update in_place @34
#     locks filled @30
