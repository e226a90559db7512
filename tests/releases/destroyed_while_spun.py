"""
Entities are made and destroyed while a pool waits for them: does its spin go on?

A race: it says ``no`` in some runs, on every line of releases since 7.1 (rule CC117). With kinds
behind it only these are destroyed: ``destroyed_while_spun.py timer client``.
"""

import os
import sys
import threading
import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import Empty as Message
from std_srvs.srv import Empty as Service

ROUNDS = 200

rclpy.init()
node = rclpy.create_node('destroyer')
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(node)
publisher = node.create_publisher(Message, 'topic', 10)


def spin() -> None:
    try:
        executor.spin()
    except BaseException as error:
        ended.append(error)


ended: list[BaseException] = []
spinning = threading.Thread(target=spin, daemon=True)
spinning.start()
for _ in range(ROUNDS):
    subscription = node.create_subscription(Message, 'topic', lambda _: None, 10)
    timer = node.create_timer(0.001, lambda: None)
    service = node.create_service(Service, 'service', lambda _, response: response)
    client = node.create_client(Service, 'service')
    for _ in range(3):
        publisher.publish(Message())
        client.call_async(Service.Request())
        time.sleep(0.002)
    for entity in (subscription, timer, client, service):
        kind = type(entity).__name__.lower()
        if not sys.argv[1:] or kind in sys.argv[1:]:
            getattr(node, f'destroy_{kind}')(entity)
    if ended:
        break
print('no' if ended else 'yes', flush=True)
os._exit(0)
