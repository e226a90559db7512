"""EffectLog: semaphores that others give back or who takes them, barriers, a message, a clock."""

import queue
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from rclpy.duration import Duration
from rclpy.wait_for_message import wait_for_message


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.signal, self.places = threading.Semaphore(0), threading.Semaphore(2)
        self.gate = threading.Barrier(2)
        self.orders = queue.Queue()
        self.orders.put('first')
        self.out = self.create_publisher(String, '/out', 10)
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.take)
        self.create_timer(1.0, self.listen)

    def on_in(self, msg):
        self.gate.wait()
        self.signal.release()
        self.out.publish(msg)

    def take(self):
        self.signal.acquire()
        self.places.acquire()
        self.gate.wait(timeout=5.0)
        self.places.release()
        self.orders.get()

    def listen(self):
        wait_for_message(String, self, 'out')
        wait_for_message(String, self, 'other', time_to_wait=1.0)
        self.get_clock().sleep_for(Duration(seconds=1))


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()


# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer take in a_default every 1
#     blocks Semaphore.acquire on on_in through signal each @31
#       ended by on_in after 1 @27
#     blocks Barrier.wait on gate all 5.0 s @33
#       ended by on_in @26
#     blocks Queue.get on orders each initial=1 @35
#       ended by ?
#     writes orders update in_place @35
#     locks places @32
#   timer listen in a_default every 1
#     blocks wait_for_message on out @38
#       ended by on_in after 1 @28
#     blocks wait_for_message on other 1.0 s @39
#     blocks Clock.sleep_for 1.0 s @40
#   subscription on_in in a_default key=in
#     blocks Barrier.wait on gate all @26
#       ended by take after 1 @33
#     publishes /out after 1 @28
