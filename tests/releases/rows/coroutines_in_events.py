"""A service of an ``EventsExecutor`` is a coroutine: is it answered?"""

import sys

import rclpy
from std_srvs.srv import Empty

PATIENCE_S = 5.0

try:
    from rclpy.experimental import EventsExecutor
except ImportError:
    sys.exit(print('no'))


async def answer(_request: Empty.Request, response: Empty.Response) -> Empty.Response:
    return response


rclpy.init()
node = rclpy.create_node('answerer')
node.create_service(Empty, 'answer', answer)
client = node.create_client(Empty, 'answer')
executor = EventsExecutor()
executor.add_node(node)
client.wait_for_service(PATIENCE_S)
future = client.call_async(Empty.Request())
try:
    executor.spin_until_future_complete(future, PATIENCE_S)
except TypeError:
    print('no', flush=True)
else:
    print('yes' if future.done() else 'no', flush=True)
