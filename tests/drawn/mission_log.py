import queue
import tempfile
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class MissionLog(Node):

    def __init__(self, expected):
        super().__init__('mission_log')
        self._expected = expected
        self._received = 0
        self._lines = queue.Queue()
        self._running = True
        self.finished = rclpy.Future()
        self.create_subscription(String, 'mission/event', self.on_event, 50)
        self._writer = threading.Thread(target=self.write_lines, name='writer')
        self._writer.start()

    def on_event(self, msg):
        self._lines.put(msg.data)
        self._received += 1
        if self._received == self._expected:
            self.finished.set_result(True)

    def write_lines(self):
        with tempfile.TemporaryFile('w+') as log:
            while self._running:
                line = self._lines.get()
                log.write(line + '\n')
                log.flush()

    def destroy_node(self):
        self._running = False
        self._writer.join()
        super().destroy_node()


class Robot(Node):

    def __init__(self):
        super().__init__('robot')
        self._pub = self.create_publisher(String, 'mission/event', 50)
        self._step = 0
        self.create_timer(0.2, self.on_tick)

    def on_tick(self):
        self._step += 1
        self._pub.publish(String(data=f'waypoint {self._step} reached'))


def main():
    rclpy.init()
    log = MissionLog(expected=10)
    robot = Robot()
    executor = SingleThreadedExecutor()
    executor.add_node(log)
    executor.add_node(robot)
    try:
        executor.spin_until_future_complete(log.finished)
        log.get_logger().info('mission complete')
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        log.destroy_node()
        robot.destroy_node()
        rclpy.try_shutdown()
    print('closed', flush=True)


if __name__ == '__main__':
    main()
