"""EffectLog: parameter callbacks run in services of rclpy, and where the node sets parameters itself."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.declare_parameter('gain', 1.0)
        self.gain = 1.0
        self.asked = 0
        self.add_pre_set_parameters_callback(self.count)
        self.add_on_set_parameters_callback(self.on_set)
        self.add_post_set_parameters_callback(self.take)
        self.create_timer(9.0, self.tick)

    def count(self, parameters):
        self.asked += 1
        return parameters

    def on_set(self, parameters):
        return SetParametersResult(successful=True)

    def take(self, parameters):
        self.gain = parameters[0].value

    def tick(self):
        self.set_parameters([Parameter('gain', value=2.0)])


class Quiet(Node):
    def __init__(self):
        super().__init__('quiet', start_parameter_services=False)
        self.add_on_set_parameters_callback(self.never)
        self.create_timer(9.0, self.tick)

    def never(self, parameters):
        return SetParametersResult(successful=True)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in A(), Quiet():
        executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_quiet: SingleThreadedExecutor x1 spin, main
#   nodes a, quiet
#   group a_default EXCLUSIVE default
#   group quiet_default EXCLUSIVE default
#   timer a_tick in a_default (A.tick) every 9 node=a
#     writes A.asked update @31>21
#     writes A.gain @31>28
#   parameter_service count in a_default node=a
#     writes A.asked update @21
#   parameter_service on_set in a_default node=a
#   parameter_service take in a_default node=a
#     writes A.gain @28
#   timer quiet_tick in quiet_default (Quiet.tick) every 9 node=quiet
