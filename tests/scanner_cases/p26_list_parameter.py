"""P26: a loop over a parameter goes over its default, by an assumption that is reported."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Fleet(Node):
    def __init__(self):
        super().__init__('fleet')
        self.declare_parameters(
            'robots',
            [('names', ['left', 'right']), ('sensors', ['scan']), ('rates', [10.0, 5.0]), ('n', 2)],
        )
        self.declare_parameter('none', [''])
        names = self.get_parameter('robots.names').get_parameter_value().string_array_value
        rates, number = self.get_parameters(['robots.rates', 'robots.n'])
        for name in names:
            group = MutuallyExclusiveCallbackGroup()
            for sensor in self.get_parameter('robots.sensors').value:
                topic = f'/{name}/{sensor}'
                self.create_subscription(String, topic, self.on_msg, 10, callback_group=group)
        for index, name in enumerate(names):
            self.create_timer(1.0 / rates.value[index], lambda name=name: self.tick(name))
        for name, rate in zip(names, rates.value):
            self.create_subscription(String, f'{name}/at', self.on_rate, int(rate))
        self.ticks = [self.create_timer(2.0, self.each) for _ in range(number.value)]
        first, _ = names
        self.create_subscription(String, first + '/first', self.on_rate, 10)

    def on_msg(self, msg):
        pass

    def on_rate(self, msg):
        pass

    def tick(self, name):
        pass

    def each(self):
        pass


def main():
    rclpy.init()
    node = Fleet()
    threads = node.declare_parameter('threads', 4).value
    executor = MultiThreadedExecutor(num_threads=max(2, threads))
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit fleet: MultiThreadedExecutor x4 spin, main
#   group group EXCLUSIVE
#   group group_2 EXCLUSIVE
#   group fleet_default EXCLUSIVE default
#   timer lambda_tick in fleet_default (Fleet.__init__.<locals>.<lambda>) every 0.1 ASSUMED
#   timer lambda_tick_2 in fleet_default (Fleet.__init__.<locals>.<lambda>) every 0.2 ASSUMED
#   timer each in fleet_default every 2 ASSUMED
#   timer each_2 in fleet_default (Fleet.each) every 2 ASSUMED
#   subscription left_scan_on_msg in group (Fleet.on_msg) key=/left/scan ASSUMED
#   subscription right_scan_on_msg in group_2 (Fleet.on_msg) key=/right/scan ASSUMED
#   subscription left_at_on_rate in fleet_default (Fleet.on_rate) key=left/at ASSUMED
#   subscription right_at_on_rate in fleet_default (Fleet.on_rate) key=right/at ASSUMED
#   subscription left_first_on_rate in fleet_default (Fleet.on_rate) key=left/first ASSUMED
