"""The last item of a list to which a loop appends is the one that it has made."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.create_service(Trigger, 'store', self.on_store)

    def write(self, name):
        pass

    def on_store(self, request, response):
        threads = []
        for name in request.names:
            threads.append(threading.Thread(target=self.write, args=(name,)))
            threads[{index}].start()
        for thread in threads:
            thread.join()
        return response

rclpy.init()
rclpy.spin(Store())
"""


def _reason(index: str) -> str | None:
    (unit,) = scan_text(PROGRAM.format(index=index)).units
    (callback,) = unit.callbacks
    escapes = [each.escapes for each in callback.blocking if each.call == 'Thread.join']
    return next((each.reason for each in escapes if each is not None), None)


def test_it_is_started_where_it_is_asked_for() -> None:
    assert _reason('-1') is None


def test_another_one_may_be_at_a_place_that_is_counted_from_the_front() -> None:
    assert _reason('0') is not None
