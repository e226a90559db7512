"""EffectLog: the main program beside a thread that spins: it waits, reads, and sets an event."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.value = None
        self.go_on = threading.Event()
        self.client = self.create_client(Trigger, 'go')
        self.create_subscription(String, 'in', self.on_in, 10)

    def on_in(self, msg):
        self.go_on.wait()
        self.value = msg


def main():
    rclpy.init()
    node = A()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    node.client.call(Trigger.Request())
    node.go_on.set()
    print(node.value)
    rclpy.shutdown()
    thread.join()


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 spin in thread, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in
#     blocks Event.wait on go_on @21
#       ended by main after 1 @33
#     writes A.value @22
#   client go_client in a_default key=go
#   activity main main
#     blocks client.call on go_client @32
#     blocks Thread.join on thread @36
#       ended by outside @31
#     reads A.value @34
