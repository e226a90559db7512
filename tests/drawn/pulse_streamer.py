import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Float32
from std_srvs.srv import Trigger


class PulseStreamer(Node):
    """Streams samples from a reader thread; the output topic can be switched."""

    CHANNELS = ('pulse/raw', 'pulse/filtered')

    def __init__(self):
        super().__init__('pulse_streamer')
        self._channel = 0
        self._out = self.create_publisher(Float32, self.CHANNELS[0], 10)
        self._running = threading.Event()
        self._running.set()
        self._reader = threading.Thread(target=self._read_loop, daemon=True)
        self.create_service(Trigger, 'switch_channel', self._on_switch)
        self._reader.start()

    def _read_loop(self):
        count = 0
        while self._running.is_set():
            sample = Float32(data=float(count % 128))
            self._out.publish(sample)
            count += 1
            if count % 200 == 0:
                self.get_logger().info('%d samples streamed' % count)
            time.sleep(0.002)

    def _prepare_channel(self, name):
        time.sleep(0.02)
        return self.create_publisher(Float32, name, 10)

    def _on_switch(self, request, response):
        self._channel = (self._channel + 1) % len(self.CHANNELS)
        name = self.CHANNELS[self._channel]
        self.destroy_publisher(self._out)
        self._out = self._prepare_channel(name)
        response.success = True
        response.message = name
        return response

    def stop(self):
        self._running.clear()
        self._reader.join()


class Operator(Node):
    """Switches the channel now and then."""

    def __init__(self):
        super().__init__('operator')
        self._client = self.create_client(Trigger, 'switch_channel')
        self.create_timer(1.0, self._tick)

    def _tick(self):
        if self._client.service_is_ready():
            future = self._client.call_async(Trigger.Request())
            future.add_done_callback(
                lambda f: self.get_logger().info('channel is now %s' % f.result().message))


def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    streamer = PulseStreamer()
    operator = Operator()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(streamer)
    executor.add_node(operator)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        streamer.stop()
        streamer.destroy_node()
        operator.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
