"""EffectLog: a coroutine awaits one future after the other, kept in one place; others find each there."""

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Stair(Node):
    def __init__(self):
        super().__init__('stair')
        self.step = None
        self.landings = []
        self.doors = []
        self.create_timer(0.1, self.lift)
        self.create_timer(0.3, self.unlock)
        self.create_timer(1.0, self.climb)
        self.create_timer(0.2, self.land)

    async def climb(self):
        self.step = Future()
        await self.step
        self.step = Future()
        await self.step
        last = Future()
        self.landings.append(last)
        await last
        self.landings = []
        door = Future()
        self.doors.append(door)
        await door

    def lift(self):
        if self.step is not None and not self.step.done():
            self.step.set_result(True)

    def unlock(self):
        doors, self.doors = self.doors, []
        for door in doors:
            door.set_result(True)

    def land(self):
        for landing in self.landings:
            landing.set_result(True)


def main():
    rclpy.init()
    rclpy.spin(Stair())


if __name__ == '__main__':
    main()

# expect:
# unit stair: SingleThreadedExecutor x1 rclpy.spin, main
#   group stair_default EXCLUSIVE default
#   timer lift in stair_default every 0.1
#     reads Stair.step @33
#     reads Stair.step @33
#     reads Stair.step rests later @34
#   timer unlock in stair_default every 0.3
#     reads Stair.doors @37
#     writes Stair.doors rests @37
#   timer climb in stair_default every 1 coroutine
#     blocks await on lift through step @21
#       ended by lift conditional @34
#     blocks await on lift through step#2 @23
#       ended by lift conditional @34
#     blocks await on land through last @26
#       ended by land conditional @43
#     blocks await on unlock through door @30
#       ended by unlock conditional @39
#     reads Stair.step @21
#     reads Stair.step @23
#     writes Stair.step @20
#     writes Stair.step @22
#     writes Stair.landings update in_place @25
#     writes Stair.landings @27
#     writes Stair.doors update in_place @29
#   timer land in stair_default every 0.2
#     reads Stair.landings iterates list @42
