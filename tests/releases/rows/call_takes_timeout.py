"""Has ``Client.call`` a ``timeout_sec``?"""

import inspect

from rclpy.client import Client

print('yes' if 'timeout_sec' in inspect.signature(Client.call).parameters else 'no', flush=True)
