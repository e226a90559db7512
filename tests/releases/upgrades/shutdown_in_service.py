"""An operator's service ends the process."""

import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import Trigger


class Kiosk(Node):
    def __init__(self):
        super().__init__('kiosk')
        self.create_service(Trigger, 'quit', self.on_quit)
        self.client = self.create_client(Trigger, 'quit')
        self.create_timer(0.3, self.press)

    def press(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())

    def on_quit(self, request, response):
        self.quit()
        response.success = True
        return response

    def quit(self):
        # differs: shutdown-waits-not, shutdown-destroys-nodes
        rclpy.try_shutdown()
        print('quit', flush=True)


def main():
    rclpy.init()
    kiosk = Kiosk()
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(kiosk)
    print('end', flush=True)


if __name__ == '__main__':
    main()
