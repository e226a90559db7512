"""EffectLog: a flag that is found down and put up is held like a lock until it is put down again."""

import threading

import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.busy = False
        self.asking = False
        self.accepted = None
        self.level = None
        self.steps = 0
        self.client = self.create_client(Trigger, 'ask')
        self.create_timer(1.0, self.by_goal)
        self.create_timer(1.0, self.by_arm)
        self.create_timer(1.0, self.on_some_ways)
        self.create_timer(1.0, self.by_object)
        self.create_timer(1.0, self.by_zero)
        ActionServer(self, Fibonacci, 'f', self.execute, goal_callback=self.on_goal)

    def by_goal(self):
        if self.asking:
            return
        self.asking = True
        self.steps = 1
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)
        self.steps = 2

    def on_done(self, future):
        self.steps = 3
        self.asking = False
        self.steps = 4

    def by_arm(self):
        with self.lock:
            if not self.busy:
                self.busy = True
                self.steps = 5
            self.steps = 6

    def on_some_ways(self):
        self.claim()
        self.steps = 7

    def claim(self):
        if self.asking:
            return False
        self.asking = True
        return True

    def by_object(self):
        if self.accepted is not None:
            self.get_logger().info('busy')
        self.accepted = object()
        self.steps = 8

    def by_zero(self):
        if self.level is None:
            self.level = 0
            self.steps = 10
            self.level = None
            self.steps = 11

    def on_goal(self, request):
        with self.lock:
            if self.busy:
                return GoalResponse.REJECT
            self.busy = True
        return GoalResponse.ACCEPT

    def execute(self, goal_handle):
        self.steps = 9
        goal_handle.succeed()
        with self.lock:
            self.busy = False
        self.steps = 10
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer by_goal in a_default every 1
#     reads A.asking @31
#     writes A.asking rests constant under A.asking (flag) @33
#     writes A.steps under A.asking (flag) @34
#     writes A.steps @36
#     changes done_callback holding A.asking (flag) @35
#   timer by_arm in a_default every 1
#     reads A.busy under lock @45
#     writes A.busy rests constant under lock, A.busy (flag) @46
#     writes A.steps under lock, A.busy (flag) @47
#     writes A.steps under lock @48
#     locks lock @44
#   timer on_some_ways in a_default every 1
#     reads A.asking @51>55
#     writes A.asking rests constant under A.asking (flag) @51>57
#     writes A.steps @52
#   timer by_object in a_default every 1
#     reads A.accepted @61
#     writes A.accepted @63
#     writes A.steps @64
#   timer by_zero in a_default every 1
#     reads A.level @67
#     writes A.level rests constant under A.level (flag) @68
#     writes A.steps under A.level (flag) @69
#     writes A.level clears under A.level (flag) @70
#     writes A.steps @71
#   client ask_client in a_default key=ask
#   action_server f_action_server in a_default (A.on_goal) key=f
#     reads A.busy admits under lock @75
#     writes A.busy rests constant under lock, A.busy (flag) @77
#     locks lock @74
#   action_execute execute in no_group key=f
#     writes A.steps under A.busy (flag) @81
#     writes A.busy under A.busy (flag), lock @84
#     writes A.steps @85
#     locks lock @83
#   done_callback on_done in no_group key=ask conditional when=callback
#     writes A.steps under A.asking (flag) @39
#     writes A.asking under A.asking (flag) @40
#     writes A.steps @41
