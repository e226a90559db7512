from handler import Handler


class ArmHandler(Handler):
    def setup(self):
        self.forward('arm')
