"""A service queues jobs as tasks of the executor."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class JobServer(Node):
    def __init__(self, executor):
        super().__init__('job_server')
        self.jobs_executor = executor
        self.create_service(Trigger, 'work', self.on_work)

    def on_work(self, request, response):
        for name in ('weigh', 'pack', 'ship'):
            # differs: tasks-oldest-first
            self.jobs_executor.create_task(self.do_job, name)
        response.success = True
        return response

    def do_job(self, name):
        print(name, flush=True)


class Customer(Node):
    def __init__(self):
        super().__init__('customer')
        self.client = self.create_client(Trigger, 'work')
        self.asked = False
        self.create_timer(0.2, self.ask)

    def ask(self):
        if not self.asked and self.client.service_is_ready():
            self.asked = True
            self.client.call_async(Trigger.Request())


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(JobServer(executor))
    executor.add_node(Customer())
    executor.spin()


if __name__ == '__main__':
    main()
