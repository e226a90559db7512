"""P30: a class method sets up what another class method spins in a thread."""
# live: no, a test runner calls the class methods

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Probe(Node):
    def __init__(self):
        super().__init__('probe')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


class TestProbe:
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.probe = Probe()
        cls.serving = SingleThreadedExecutor()
        cls.serving.add_node(cls.probe)
        cls.over = threading.Event()
        threading.Thread(target=cls.serve, daemon=True).start()

    @classmethod
    def serve(cls):
        while not cls.over.is_set():
            cls.serving.spin_once(timeout_sec=0.1)


# expect:
# unit probe: serving=SingleThreadedExecutor x1 spin_once in thread
#   group probe_default EXCLUSIVE default
#   timer tick in probe_default every 1 when=later
#   activity thread serve (TestProbe.serve) conditional daemon loops
#     reads TestProbe.over @32
#     reads TestProbe.serving @33
