"""E24: a wait on a branch that a parameter chooses and its default does not names the setting."""

import time

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.declare_parameter('waits', False)
        self.waits = self.get_parameter('waits').value
        self.mode = self.declare_parameter('mode', 'fast').value
        self.client = self.create_client(Trigger, 'ready')
        self.create_timer(0.5, self.drive)
        self.create_timer(0.5, self.look)

    def drive(self):
        if self.waits:
            self.client.call(Trigger.Request())
        else:
            self.client.call_async(Trigger.Request())

    def look(self):
        if self.mode == 'fast':
            time.sleep(0.01)
        else:
            time.sleep(0.02)
        if not self.mode:
            time.sleep(0.03)


def main():
    rclpy.init()
    rclpy.spin(Navigator())


if __name__ == '__main__':
    main()

# expect:
# unit navigator: SingleThreadedExecutor x1 rclpy.spin, main
#   group navigator_default EXCLUSIVE default
#   timer drive in navigator_default every 0.5
#     blocks client.call on ready_client conditional only if self.waits holds @22
#     reads Navigator.waits @21
#   timer look in navigator_default every 0.5
#     blocks time.sleep conditional 0.01 s @28
#     blocks time.sleep conditional 0.02 s only if self.mode == 'fast' does not hold @30
#     blocks time.sleep conditional 0.03 s only if not self.mode holds @32
#     reads Navigator.mode @27
#     reads Navigator.mode @31
#   client ready_client in navigator_default key=ready
