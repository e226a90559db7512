"""EffectLog: a flag that is asked for beside something else is found down, and put up by execute too."""

import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.asking = False
        self.busy = False
        self.moving = False
        self.steps = 0
        self.client = self.create_client(Trigger, 'ask')
        self.create_timer(1.0, self.ask)
        self.create_timer(1.0, self.either)
        ActionServer(self, Fibonacci, 'f', self.execute, goal_callback=self.on_goal)

    def ask(self):
        if not self.asking and self.client.service_is_ready():
            self.asking = True
            self.steps = 1
            self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)

    def on_done(self, future):
        self.steps = 2
        self.asking = False

    def either(self):
        if self.moving or self.client.service_is_ready():
            return
        self.moving = True
        self.steps = 3
        self.moving = False

    async def on_goal(self, request):
        if self.busy:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    async def execute(self, goal_handle):
        self.busy = True
        self.steps = 4
        await self.client.call_async(Trigger.Request())
        self.busy = False
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer ask in a_default every 1
#     reads A.asking @23
#     writes A.asking rests constant under A.asking (flag) @24
#     writes A.steps under A.asking (flag) @25
#     changes done_callback holding A.asking (flag) @26
#   timer either in a_default every 1
#     reads A.moving @33
#     writes A.moving rests constant under A.moving (flag) @35
#     writes A.steps under A.moving (flag) @36
#     writes A.moving under A.moving (flag) @37
#   client ask_client in a_default key=ask
#   action_server f_action_server in a_default (A.on_goal) key=f coroutine
#     reads A.busy admits @40
#   action_execute execute in no_group key=f coroutine
#     blocks await on ask_client @47
#     writes A.busy under A.busy (flag) @45
#     writes A.steps under A.busy (flag) @46
#     writes A.busy under A.busy (flag) @48
#   done_callback on_done in no_group key=ask conditional when=callback
#     writes A.steps under A.asking (flag) @29
#     writes A.asking under A.asking (flag) @30
