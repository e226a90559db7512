"""Point 23: a function whose name a library's wrapper takes over; no known code calls it."""
# live: no, there is no program

import pytest
import rclpy
from std_srvs.srv import Trigger


def test_asks(domain):
    rclpy.init()
    node = rclpy.create_node('asker')
    client = node.create_client(Trigger, 'go')
    rclpy.spin_until_future_complete(node, client.call_async(Trigger.Request()))


test_asks = pytest.mark.slow(test_asks)

# expect:
# unit asker: SingleThreadedExecutor x1 rclpy.spin_until_future_complete
#   group asker_default EXCLUSIVE default
#   client go_client in asker_default key=go
