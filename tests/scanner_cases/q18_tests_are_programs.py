"""Point 18: tests that spin by ``rclpy.spin_once`` share no executor: each is its own program."""
# live: no, nobody runs the tests

import unittest

import pytest
import rclpy
from rclpy.node import Node


class Pump(Node):
    def __init__(self, name='pump'):
        super().__init__(name)
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


class TestOfPytest:
    def test_runs(self):
        rclpy.init()
        rclpy.spin_once(Pump())
        rclpy.shutdown()

    def test_stops(self):
        rclpy.init()
        rclpy.spin_once(Pump('other'))
        rclpy.shutdown()


class TestOfUnittest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()
        cls.shared = rclpy.create_node('shared')

    def test_alone(self):
        rclpy.spin_once(self.shared)

    def test_with_a_pump(self):
        pump = Pump('second')
        rclpy.spin_once(pump)


@pytest.mark.parametrize('name', ['x'])
def test_function(name):
    rclpy.init()
    rclpy.spin_once(Pump('third'))
    rclpy.shutdown()


def test_another_function(tmp_path):
    rclpy.init()
    rclpy.spin_once(Pump('fourth'))
    rclpy.shutdown()

# expect:
# unit pump: SingleThreadedExecutor x1 rclpy.spin_once
#   group pump_default EXCLUSIVE default
#   timer tick in pump_default every 1 when=later
# unit other: SingleThreadedExecutor x1 rclpy.spin_once
#   group other_default EXCLUSIVE default
#   timer tick in other_default every 1 when=later
# unit shared: SingleThreadedExecutor x1 rclpy.spin_once
# unit second: SingleThreadedExecutor x1 rclpy.spin_once
#   group second_default EXCLUSIVE default
#   timer tick in second_default every 1 when=later
# unit third: SingleThreadedExecutor x1 rclpy.spin_once
#   group third_default EXCLUSIVE default
#   timer tick in third_default every 1
# unit fourth: SingleThreadedExecutor x1 rclpy.spin_once
#   group fourth_default EXCLUSIVE default
#   timer tick in fourth_default every 1
