"""E40: simulated time stands still until the node has taken a message of /clock."""

import threading

import rclpy
import rclpy.executors
from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter


class Walker(Node):
    def __init__(self):
        super().__init__(
            'walker', parameter_overrides=[Parameter('use_sim_time', Parameter.Type.BOOL, True)]
        )
        self.rate = self.create_rate(5)
        self.create_timer(1.0, self.walk)
        threading.Thread(target=self.run, daemon=True).start()

    def walk(self):
        self.get_clock().sleep_for(Duration(seconds=0.2))

    def run(self):
        self.rate.sleep()


class Jumper(Node):
    def __init__(self):
        super().__init__('jumper')
        self.set_parameters([Parameter('use_sim_time', value=True)])
        threshold = JumpThreshold(min_forward=Duration(seconds=1), min_backward=None)
        self.jumps = self.get_clock().create_jump_callback(threshold, post_callback=self.jump)

    def jump(self, time_jump):
        self.jumped = time_jump


class Sleeper(Node):
    def __init__(self):
        super().__init__('sleeper')
        self.create_timer(1.0, self.doze)

    def doze(self):
        self.get_clock().sleep_for(Duration(seconds=2))
        self.get_clock().sleep_until(self.get_clock().now() + Duration(seconds=3))


def main():
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(Walker())
    executor.add_node(Jumper())
    executor.add_node(Sleeper())
    executor.spin()


if __name__ == '__main__':
    main()


# expect:
# unit walker_and_2_more: SingleThreadedExecutor x1 spin, main
#   nodes walker, jumper, sleeper
#   group rate_group REENTRANT library=rclpy.create_rate
#   group walker_default EXCLUSIVE default
#   group jumper_default EXCLUSIVE default
#   group sleeper_default EXCLUSIVE default
#   timer rate_timer in rate_group every 0.2 node=walker library=rclpy.create_rate
#   timer walk in walker_default every 1 node=walker
#     blocks Clock.sleep_for on clock_callback through /clock all @23
#   subscription clock_callback in walker_default key=/clock node=walker builtin
#   subscription jump in jumper_default key=/clock node=jumper library=rclpy.time_source
#     writes Jumper.jumped @37
#   timer doze in sleeper_default every 1 node=sleeper
#     blocks Clock.sleep_for 2.0 s @46
#     blocks Clock.sleep_until 3.0 s @47
#   activity thread run (Walker.run) daemon
#     blocks Rate.sleep on clock_callback through /clock all @26
#     blocks Rate.sleep on rate_timer @26
