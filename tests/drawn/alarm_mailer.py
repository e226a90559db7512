"""Supervisor of a work cell: counts parts, mails alarms, can be told to quit."""
import collections
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import UInt64
from std_srvs.srv import Trigger


class AlarmMailer:
    """Sends alarms from a thread of its own, since the mail relay is slow."""

    def __init__(self, send):
        self._send = send
        self._alarms = collections.deque()
        self._cond = threading.Condition()
        self._running = True
        self._thread = threading.Thread(target=self._loop, name='mailer')
        self._thread.start()

    def post(self, text):
        with self._cond:
            self._alarms.append(text)
            self._cond.notify()

    def _loop(self):
        while self._running:
            with self._cond:
                while not self._alarms:
                    self._cond.wait()
                text = self._alarms.popleft()
            self._send(text)

    def close(self):
        self._running = False
        self._thread.join()


class Station(Node):

    def __init__(self, name):
        super().__init__(name)
        self._count = 0
        self._pub = self.create_publisher(UInt64, f'{name}/parts', 10)
        self.create_timer(0.1, self._produce)

    def _produce(self):
        self._count += 1
        self._pub.publish(UInt64(data=self._count))


class Supervisor(Node):

    def __init__(self, stations):
        super().__init__('supervisor')
        self.quit = Future()
        self._mailer = AlarmMailer(self._mail)
        for station in stations:
            self.create_subscription(
                UInt64, f'{station}/parts',
                lambda msg, station=station: self._on_parts(station, msg.data), 10)
        self.create_service(Trigger, 'supervisor/quit', self._on_quit)

    def _mail(self, text):
        time.sleep(0.05)
        self.get_logger().info(f'mailed: {text}')

    def _on_parts(self, station, count):
        if count % 10 == 0:
            self._mailer.post(f'{station}: {count} parts, box full')

    def _on_quit(self, request, response):
        self.get_logger().info('quit requested')
        if not self.quit.done():
            self.quit.set_result(True)
        response.success = True
        return response

    def destroy_node(self):
        self._mailer.close()
        super().destroy_node()


class Panel(Node):

    def __init__(self):
        super().__init__('panel')
        self._client = self.create_client(Trigger, 'supervisor/quit')
        self._timer = self.create_timer(2.6, self._press)

    def _press(self):
        if self._client.service_is_ready():
            self._timer.cancel()
            self._client.call_async(Trigger.Request())


def main():
    rclpy.init()
    names = ['press', 'lathe']
    supervisor = Supervisor(names)
    nodes = [supervisor, Panel()] + [Station(n) for n in names]
    executor = SingleThreadedExecutor()
    for node in nodes:
        executor.add_node(node)
    try:
        executor.spin_until_future_complete(supervisor.quit)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        for node in nodes:
            node.destroy_node()
        executor.shutdown()
        rclpy.try_shutdown()
    print('cell stopped', flush=True)


if __name__ == '__main__':
    main()
