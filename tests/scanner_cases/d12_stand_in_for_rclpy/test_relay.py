import sys
from unittest.mock import MagicMock

rclpy = MagicMock()
sys.modules['rclpy'] = rclpy
sys.modules['rclpy.node'] = MagicMock()

from relay import relay  # noqa: E402


def test_two_topics():
    relay(['x', 'y'])
    rclpy.spin.assert_called_once()
