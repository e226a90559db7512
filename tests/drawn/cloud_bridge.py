import asyncio
import json
import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import Temperature


class CloudBridge(Node):
    """Forwards temperature readings to a cloud endpoint from an asyncio thread."""

    def __init__(self):
        super().__init__('cloud_bridge')
        self.declare_parameter('device_id', 'greenhouse-7')
        self._device = self.get_parameter('device_id').value
        self._loop = asyncio.new_event_loop()
        self._outbox = None
        self._started = threading.Event()
        self._thread = threading.Thread(target=self._run_loop, daemon=True)
        self._thread.start()
        self._started.wait()
        self._received = 0
        self.create_subscription(Temperature, 'temperature', self._on_temperature, 10)

    def _run_loop(self):
        asyncio.set_event_loop(self._loop)
        self._outbox = asyncio.Queue()
        self._loop.call_soon(self._started.set)
        try:
            self._loop.run_until_complete(self._forward())
        finally:
            self._loop.close()

    async def _forward(self):
        sent = 0
        while True:
            document = await self._outbox.get()
            if document is None:
                return
            await self._post(document)
            sent += 1
            if sent % 10 == 0:
                self.get_logger().info('%d documents sent' % sent)

    async def _post(self, document):
        body = json.dumps(document).encode()
        await asyncio.sleep(0)
        return len(body)

    def _on_temperature(self, msg):
        self._received += 1
        document = {'device': self._device, 'n': self._received,
                    'celsius': round(msg.temperature, 2)}
        self._outbox.put_nowait(document)

    def close(self):
        self._loop.call_soon_threadsafe(self._outbox.put_nowait, None)
        self._thread.join()


class Thermometer(Node):
    """A slowly warming sensor."""

    def __init__(self):
        super().__init__('thermometer')
        self._value = 18.0
        self._pub = self.create_publisher(Temperature, 'temperature', 10)
        self.create_timer(0.05, self._tick)

    def _tick(self):
        self._value += 0.01
        self._pub.publish(Temperature(temperature=self._value))


def main():
    rclpy.init()
    bridge = CloudBridge()
    sensor = Thermometer()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(bridge)
    executor.add_node(sensor)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        bridge.close()
        bridge.destroy_node()
        sensor.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
