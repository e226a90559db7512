"""P52: a pool's callbacks spin helpers that nothing else serves; others outside end that."""
# live: no, no package of Nav2 among the wheels

import rclpy
from geometry_msgs.msg import PoseStamped
from nav2_simple_commander.robot_navigator import BasicNavigator
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self, name, service):
        super().__init__(name)
        self.cli = self.create_client(Trigger, service)

    def ask(self):
        future = self.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)


class Waiter(Asker):
    def __init__(self):
        super().__init__('waiter', 'other')
        self.create_subscription(Empty, 'go', self.on_go, 1)

    def on_go(self, msg):
        self.cli.call(Trigger.Request())


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.navigator = BasicNavigator()
        self.plain = Asker('plain', 'other')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.navigator.goToPose(PoseStamped())
        while not self.navigator.isTaskComplete():
            pass
        self.plain.ask()
        rclpy.spin_once(self.plain, timeout_sec=0.2)


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.mine = Asker('mine', 'own')
        self.waiter = Waiter()
        self.create_service(Trigger, 'own', self.own)
        self.create_timer(1.0, self.tick)

    def own(self, request, response):
        return response

    def tick(self):
        self.mine.ask()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(2)
    executor.add_node(A())
    executor.spin()


def other():
    rclpy.init()
    executor = MultiThreadedExecutor(2)
    executor.add_node(B())
    executor.spin()


class C(Node):
    def __init__(self):
        super().__init__('c')
        self.waiter = Waiter()
        self.create_timer(1.0, self.waiter.ask)


def third():
    rclpy.init()
    executor = MultiThreadedExecutor(2)
    executor.add_node(C())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks rclpy.spin_until_future_complete on ? @40
#       ended by outside @40
#     blocks rclpy.spin_until_future_complete on ? 0.1 s @41
#       ended by time @41
#     blocks loop for an answer @41
#     blocks rclpy.spin_until_future_complete on ? @43>20
#       ended by time @20
#     blocks spin for future on ? @43>20
#       ended by outside @20
#     blocks rclpy.spin_once on ? 0.2 s @44
#       ended by time @44
#     changes rclpy.spin_until_future_complete @40
#     changes rclpy.spin_until_future_complete @41
#     changes rclpy.spin_until_future_complete @43>20
#     changes rclpy.spin_once @44
# unit basic_navigator: no executor, main
#   ? executor executor
# unit plain: no executor, main
#   group plain_default EXCLUSIVE default
#   client other_client in plain_default key=other
#   ? executor executor
# unit b: MultiThreadedExecutor x2 spin
#   group b_default EXCLUSIVE default
#   timer tick in b_default every 1
#     blocks rclpy.spin_until_future_complete on ? @59>20
#     blocks spin for future on ? @59>20
#     changes rclpy.spin_until_future_complete @59>20
#   service own in b_default key=own
# unit c: MultiThreadedExecutor x2 spin
#   group c_default EXCLUSIVE default
#   timer ask in c_default every 1
#     blocks rclpy.spin_until_future_complete on ? @20
#     blocks spin for future on ? @20
#     changes rclpy.spin_until_future_complete @20
# unit mine: no executor
#   group mine_default EXCLUSIVE default
#   client own_client in mine_default key=own
#   ? executor executor
# unit waiter: no executor
#   group waiter_default EXCLUSIVE default
#   subscription on_go in waiter_default key=go
#     blocks client.call on other_client @29
#   client other_client in waiter_default key=other
#   ? executor executor
