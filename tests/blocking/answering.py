"""Servers of another node on a thread of their own, as the measured table has them."""

import threading
import time

import rclpy
from rclpy import executors
from rclpy.action import ActionServer
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


def answer_elsewhere():
    node = rclpy.create_node('answerer')
    node.create_service(Trigger, 'answer', lambda request, response: response)
    node.create_service(Trigger, 'slow_answer', answer_slowly)
    spin_in_thread(node)


def answer_slowly(request, response):
    time.sleep(0.4)
    return response


def count_elsewhere():
    node = rclpy.create_node('counter')
    node.server = ActionServer(node, Fibonacci, 'count', count)
    spin_in_thread(node)


def count(goal_handle):
    goal_handle.succeed()
    return Fibonacci.Result()


def spin_in_thread(node):
    executor = executors.SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
