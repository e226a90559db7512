from handler import client_of
from std_srvs.srv import Trigger


async def stop():
    client_of(Trigger, 'stop')
