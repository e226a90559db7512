"""Signal tower: a blink thread paced by a ROS rate, started and stopped by the application."""
import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, String


class SignalTower(Node):
    def __init__(self):
        super().__init__('signal_tower')
        self.mode = 'slow'
        self.blinks = 0
        self.lamp = self.create_publisher(Bool, 'tower/lamp', 1)
        self.create_subscription(String, 'tower/mode', self.on_mode, 1)
        self.rate = self.create_rate(4.0)
        self.running = True
        self.blinker = threading.Thread(target=self.blink)
        self.blinker.start()

    def on_mode(self, msg):
        self.mode = msg.data

    def blink(self):
        lit = False
        while self.running:
            lit = not lit if self.mode != 'off' else False
            self.lamp.publish(Bool(data=lit))
            self.blinks += 1
            self.rate.sleep()

    def close(self):
        self.running = False
        self.blinker.join()
        self.get_logger().info(f'closed after {self.blinks} blinks')
        self.destroy_node()


class Application:
    def __init__(self):
        rclpy.init()
        self.tower = SignalTower()
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.tower)
        self.spinner = threading.Thread(target=self.spin)
        self.spinner.start()

    def spin(self):
        try:
            self.executor.spin()
        except ExternalShutdownException:
            pass

    def work(self, seconds):
        time.sleep(seconds)
        self.tower.get_logger().info(f'{self.tower.blinks} blinks')

    def close(self):
        self.executor.shutdown()
        self.spinner.join()
        self.tower.close()
        rclpy.try_shutdown()


def main():
    app = Application()
    try:
        app.work(3.0)
    finally:
        app.close()
    print('application ended', flush=True)


if __name__ == '__main__':
    main()
