"""A helper that is given its node later, by unknown code."""


class Behaviour:
    def setup(self, **kwargs):
        self.node = kwargs['node']
        self.node.create_timer(1.0, self.tick)

    def tick(self):
        pass
