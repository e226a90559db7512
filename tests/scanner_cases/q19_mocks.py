"""Point 19: mocks of create_* in tests are no entities."""

from unittest.mock import MagicMock

import rclpy  # noqa


def test_timer():
    node = MagicMock()
    node.create_timer(1.0, print)
    node.create_subscription.assert_not_called()

# expect:
# nothing
