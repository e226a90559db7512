"""Point 18: each test of a class is a program of its own, with what ``setUp`` makes for it."""
# live: no, nobody runs the tests

import unittest

import rclpy
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import String


class TestPump(unittest.TestCase):
    def setUp(self):
        rclpy.init()
        self.node = rclpy.create_node('pump')
        self.executor = MultiThreadedExecutor(2)
        self.executor.add_node(self.node)

    def tearDown(self):
        self.node.destroy_node()
        rclpy.shutdown()

    def test_pressure(self):
        self.node.create_subscription(String, 'pressure', self.on_msg, 10)
        self.executor.spin_once()

    def test_flow(self):
        other = rclpy.create_node('valve')
        other.create_subscription(String, 'flow', self.on_msg, 10)
        self.executor.add_node(other)
        self.executor.spin_once()

    def on_msg(self, msg):
        pass

# expect:
# unit pump: MultiThreadedExecutor x2 spin_once
#   group pump_default EXCLUSIVE default
#   subscription on_msg in pump_default key=pressure when=later
# unit pump_and_valve: MultiThreadedExecutor x2 spin_once
#   nodes pump, valve
#   group valve_default EXCLUSIVE default
#   subscription on_msg in valve_default key=flow node=valve when=later
