"""Lift gateway: the service answers once the door has reported that it is open."""
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, Empty
from std_srvs.srv import Trigger


class LiftGateway(Node):
    def __init__(self):
        super().__init__('lift_gateway')
        self.state = threading.Condition()
        self.door_open = False
        self.command = self.create_publisher(Bool, 'door/command', 10)
        self.create_subscription(
            Bool, 'door/state', self.on_state, 10,
            callback_group=MutuallyExclusiveCallbackGroup())
        self.create_service(
            Trigger, 'lift/enter', self.on_enter,
            callback_group=MutuallyExclusiveCallbackGroup())
        self.alive = self.create_publisher(Empty, 'lift/alive', 10)
        self.create_timer(0.2, lambda: self.alive.publish(Empty()))

    def on_state(self, msg):
        with self.state:
            self.door_open = msg.data
            self.state.notify_all()

    def on_enter(self, request, response):
        with self.state:
            self.command.publish(Bool(data=True))
            response.success = self.state.wait_for(lambda: self.door_open, timeout=0.9)
        response.message = 'door open' if response.success else 'door stuck'
        if not self.context.ok():
            return response
        self.command.publish(Bool(data=False))
        with self.state:
            self.state.wait_for(lambda: not self.door_open, timeout=0.9)
        return response


class Door(Node):
    """Needs a moment to move."""

    def __init__(self):
        super().__init__('door')
        self.target = False
        self.pub = self.create_publisher(Bool, 'door/state', 10)
        self.create_subscription(Bool, 'door/command', self.on_command, 10)
        self.move = self.create_timer(0.4, self.arrived)
        self.move.cancel()

    def on_command(self, msg):
        self.target = msg.data
        self.move.reset()

    def arrived(self):
        self.move.cancel()
        self.pub.publish(Bool(data=self.target))


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.rides = 0
        self.alive = 0
        self.busy = False
        self.client = self.create_client(Trigger, 'lift/enter')
        self.create_subscription(Empty, 'lift/alive', self.on_alive, 10)
        self.create_timer(0.3, self.ride)

    def on_alive(self, msg):
        self.alive += 1

    def ride(self):
        if self.busy or not self.client.service_is_ready():
            return
        self.busy = True
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_entered)

    def on_entered(self, future):
        self.busy = False
        self.rides += 1
        self.get_logger().info('ride %d: %s, %d signs of life' % (
            self.rides, future.result().message, self.alive))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (LiftGateway(), Door(), Robot()):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
