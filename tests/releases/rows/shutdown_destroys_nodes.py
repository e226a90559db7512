"""A service under ``rclpy.spin`` shuts rclpy down: can it still answer?"""

import os
import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from std_srvs.srv import Trigger

PATIENCE_S = 5.0

rclpy.init()
node = rclpy.create_node('kiosk')
client = node.create_client(Trigger, 'quit')


def leave(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
    rclpy.shutdown()
    return response


def ask() -> None:
    if client.service_is_ready():
        asking.cancel()
        client.call_async(Trigger.Request())


def give_up() -> None:
    # Humble waits for the callback, and has destroyed nothing meanwhile.
    print('no', flush=True)
    os._exit(0)


node.create_service(Trigger, 'quit', leave)
asking = node.create_timer(0.1, ask)
threading.Timer(PATIENCE_S, give_up).start()
answer = 'no'
try:
    rclpy.spin(node)
except ExternalShutdownException:
    pass
except Exception as raised:
    answer = 'yes' if type(raised).__name__ == 'InvalidHandle' else repr(raised)
print(answer, flush=True)
os._exit(0)
