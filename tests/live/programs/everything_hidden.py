"""Entities nobody wrote, a rate, a life-cycle node, a done-callback, a task, coroutines."""

import functools

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Lamp(LifecycleNode):
    """Makes its timer when it is configured."""

    def on_configure(self, state: object) -> TransitionCallbackReturn:
        self.create_timer(0.01, self.blink)
        return TransitionCallbackReturn.SUCCESS

    def blink(self) -> None:
        pass


class Switch(Node):
    """Turns the lamp on, with one of each kind of callback."""

    def __init__(self) -> None:
        super().__init__('switch')
        self.answers = 0
        self.rate = self.create_rate(10)
        self.create_service(Trigger, 'press', self.on_press)
        self.client = self.create_client(Trigger, 'press')
        self.create_subscription(String, 'log', functools.partial(self.on_log, 'prefix'), 10)

    async def on_press(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        return response

    def on_log(self, prefix: str, message: String) -> None:
        pass

    def on_answer(self, future: object) -> None:
        self.answers += 1

    def work_later(self) -> None:
        self.answers += 1

    async def think(self) -> None:
        self.answers += 1


rclpy.init()
lamp, switch = Lamp('lamp'), Switch()
executor = SingleThreadedExecutor()
executor.add_node(lamp)
executor.add_node(switch)
lamp.trigger_configure()
switch.client.wait_for_service()
switch.client.call_async(Trigger.Request()).add_done_callback(switch.on_answer)
executor.create_task(switch.work_later)
executor.create_task(switch.think())
while switch.answers < 3:
    executor.spin_once(timeout_sec=1)
print('answers', switch.answers)
executor.shutdown()
lamp.destroy_node()
switch.destroy_node()
rclpy.shutdown()
