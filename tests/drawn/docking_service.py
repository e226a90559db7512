"""Docking helper: two services that finish when the contact switch changes."""
import threading
from enum import Enum
from typing import Dict

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger


class Contact(Enum):
    OPEN = False
    CLOSED = True


class ContactWatch:
    """Lets callers wait for one of the two positions of the switch."""

    def __init__(self) -> None:
        self._events: Dict[Contact, threading.Event] = {c: threading.Event() for c in Contact}

    def update(self, contact: Contact) -> None:
        for key, event in self._events.items():
            event.set() if key is contact else event.clear()

    def expect(self, contact: Contact) -> None:
        self._events[contact].wait()


class DockingHelper(Node):

    def __init__(self) -> None:
        super().__init__('docking_helper')
        self._watch = ContactWatch()
        self._pulses = 0
        self._motion_pub = self.create_publisher(String, 'dock_motion', 10)
        self._alive_pub = self.create_publisher(String, 'dock_alive', 10)
        requests = ReentrantCallbackGroup()
        self.create_service(Trigger, 'dock', self._on_dock, callback_group=requests)
        self.create_service(Trigger, 'release', self._on_release, callback_group=requests)
        self.create_subscription(
            Bool, 'contact', self._on_contact, 10,
            callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(
            0.25, self._alive, callback_group=MutuallyExclusiveCallbackGroup())

    def _on_contact(self, msg: Bool) -> None:
        self._watch.update(Contact(msg.data))

    def _on_dock(self, _request, response):
        return self._move('forward', Contact.CLOSED, response)

    def _on_release(self, _request, response):
        return self._move('backward', Contact.OPEN, response)

    def _move(self, direction: str, until: Contact, response):
        self._motion_pub.publish(String(data=direction))
        self._watch.expect(until)
        self._motion_pub.publish(String(data='halt'))
        response.success = True
        response.message = f'{direction}: contact {until.name.lower()}'
        return response

    def _alive(self) -> None:
        self._pulses += 1
        self._alive_pub.publish(String(data=str(self._pulses)))


def main() -> None:
    rclpy.init()
    node = DockingHelper()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
