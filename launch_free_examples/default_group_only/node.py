"""
Battery watch: a subscription, a timer and a service, none of which names a group.

All three share the node's default group with the parameter services that every node carries.
"""

import argparse
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from sensor_msgs.msg import BatteryState
from std_msgs.msg import String
from std_srvs.srv import Trigger


class BatteryWatch(Node):
    """Reports the state of charge, and clears its alarm when asked to."""

    def __init__(self) -> None:
        super().__init__('battery_watch')
        self.percentage = 1.0
        self.alarm = False
        self.status = self.create_publisher(String, 'battery_status', 10)
        self.create_subscription(BatteryState, 'battery_state', self.on_battery, 10)
        self.create_timer(0.5, self.report)
        self.create_service(Trigger, 'clear_alarm', self.on_clear_alarm)

    def on_battery(self, message: BatteryState) -> None:
        self.percentage = message.percentage
        self.alarm = self.alarm or message.percentage < 0.2

    def report(self) -> None:
        state = 'alarm' if self.alarm else 'ok'
        self.status.publish(String(data=f'{self.percentage:.0%} {state}'))

    def on_clear_alarm(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        self.alarm = False
        response.success = True
        return response


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, help='stop after this time')
    options, ros_arguments = parser.parse_known_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    rclpy.init(args=ros_arguments)
    if options.seconds is not None:
        limit = threading.Timer(options.seconds, signal.raise_signal, [signal.SIGINT])
        limit.daemon = True
        limit.start()
    try:
        node = BatteryWatch()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
