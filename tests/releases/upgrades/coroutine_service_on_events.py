"""A service that is a coroutine, on the EventsExecutor."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.create_service(Trigger, 'light', self.on_light)

    # differs: coroutines-in-events
    async def on_light(self, request, response):
        print('light', flush=True)
        response.success = True
        return response


class Switch(Node):
    def __init__(self):
        super().__init__('switch')
        self.client = self.create_client(Trigger, 'light')
        self.create_timer(0.3, self.press)

    def press(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

    def on_answer(self, future):
        print('on', future.result().success, flush=True)


def main():
    rclpy.init()
    switches = SingleThreadedExecutor()
    switches.add_node(Switch())
    threading.Thread(target=switches.spin, daemon=True).start()
    # differs: events-executor
    lamps = EventsExecutor()
    lamps.add_node(Lamp())
    while rclpy.ok():
        lamps.spin_once(timeout_sec=1.0)


if __name__ == '__main__':
    main()
