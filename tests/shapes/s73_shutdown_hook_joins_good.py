"""A hook at shutdown joins a thread that waits for the callback which shuts down. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Writer(Node):
    def __init__(self):
        super().__init__('writer')
        self.stopped = threading.Event()
        self.worker = threading.Thread(target=self.write, daemon=True)
        self.worker.start()
        self.context.on_shutdown(self.finish)
        self.create_timer(1.0, self.stop)

    def write(self):
        self.stopped.wait()

    def stop(self):
        self.stopped.set()
        raise SystemExit

    def finish(self):
        self.worker.join()
        print('goes on')


def main():
    rclpy.init()
    try:
        rclpy.spin(Writer())
    finally:
        rclpy.shutdown()


if __name__ == '__main__':
    main()
