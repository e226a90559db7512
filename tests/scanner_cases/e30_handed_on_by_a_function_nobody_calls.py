"""EffectLog: what ends a wait is handed on in a function that no known code calls."""
# live: no, it needs a library that is not there

import rclpy
from elsewhere import reactor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    async def tick(self):
        future = rclpy.task.Future()

        def connect():
            reactor.connect().add_callback(future.set_result)

        reactor.call_from_thread(connect)
        await future


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1 coroutine
#     blocks await on future @21
#       ended by ?
