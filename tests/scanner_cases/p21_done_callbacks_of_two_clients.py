"""P21: a done-callback carries the name of the client whose answer it takes."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.left = self.create_client(Trigger, 'left')
        self.right = self.create_client(Trigger, 'right')
        self.answered = threading.Event()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.ask(self.left)
        self.ask(self.left)
        self.ask(self.right)
        self.left.call_async(Trigger.Request()).add_done_callback(self.go_on)
        self.answered.wait()

    def ask(self, client):
        client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        pass

    def go_on(self, future):
        self.answered.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(4)
    executor.add_node(Asker())
    executor.spin()

# expect:
# unit asker: MultiThreadedExecutor x4 spin, main
#   group asker_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer tick in asker_default every 1
#     blocks Event.wait on go_on through answered @24
#       ended by go_on @33
#     changes done_callback @20>27
#     changes done_callback @21>27
#     changes done_callback @22>27
#     changes done_callback @23
#   client left_client in asker_default key=left
#   client right_client in asker_default key=right
#   done_callback left_on_answer in no_group (Asker.on_answer) key=left conditional when=callback
#   done_callback right_on_answer in no_group (Asker.on_answer) key=right conditional when=callback
#   done_callback go_on in no_group key=left conditional when=callback
