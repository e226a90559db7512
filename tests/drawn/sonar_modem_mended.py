import asyncio

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

from helper_07_loop import LoopThread


class SurfaceBuoy(Node):
    """Far end of the acoustic link: acknowledges every packet."""

    def __init__(self):
        super().__init__('surface_buoy')
        self._pub = self.create_publisher(String, 'acoustic/ack', 10)
        self.create_subscription(String, 'acoustic/packet', self._on_packet, 10)

    def _on_packet(self, msg):
        number, _, _ = msg.data.partition('|')
        self._pub.publish(String(data=number))


class SonarModem(Node):
    """Sends depth packets over the acoustic link, one at a time."""

    def __init__(self):
        super().__init__('sonar_modem')
        self._acks = {}
        self._number = 0
        self._io = LoopThread('modem-io')
        self._pub = self.create_publisher(String, 'acoustic/packet', 10)
        self.create_subscription(String, 'acoustic/ack', self._on_ack, 10,
                                 callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self._send_depth)

    async def _transmit(self, number, text):
        acked = self._io.loop.create_future()
        self._acks[number] = acked
        while self._pub.get_subscription_count() == 0:
            await asyncio.sleep(0.05)
        self._pub.publish(String(data='%d|%s' % (number, text)))
        await acked
        del self._acks[number]
        return number

    def _resolve(self, number):
        acked = self._acks.get(number)
        if acked is not None and not acked.done():
            acked.set_result(True)

    def _on_ack(self, msg):
        self._io.call(self._resolve, int(msg.data))

    def _send_depth(self):
        self._number += 1
        depth = 12.0 + 0.1 * (self._number % 20)
        number = self._io.run(self._transmit(self._number, 'depth=%.1f' % depth))
        self.get_logger().info('packet %d acknowledged' % number)

    def destroy_node(self):
        self._io.stop()
        super().destroy_node()


def main():
    rclpy.init()
    buoy = SurfaceBuoy()
    modem = SonarModem()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(buoy)
    executor.add_node(modem)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        modem.destroy_node()
        buoy.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
