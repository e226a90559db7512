"""EffectLog: who ends a wait is not the variable of the same name in a function nobody calls."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future


async def nap(node, seconds):
    future = Future()
    group = MutuallyExclusiveCallbackGroup()

    def done():
        future.set_result(None)

    node.create_timer(seconds, done, callback_group=group)
    await future


async def first_of(node, seconds):
    future = Future()

    def over():
        future.set_result(None)

    node.create_timer(seconds, over)
    await future


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    async def tick(self):
        await nap(self, 0.5)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group group EXCLUSIVE count=?
#   timer tick in a_default every 1 coroutine
#     blocks await on done through future @36>17
#       ended by done @14
#     changes timer @36>16
#   timer done in group every 0.5 conditional count=? when=callback
#   ? done count
#   ? group count
# unit node: no executor
#   group node_default EXCLUSIVE default
#   timer over in node_default every ? node=?
#   ? over node
#   ? over period
#   ? executor executor
