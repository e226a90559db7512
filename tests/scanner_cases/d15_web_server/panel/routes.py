from fastapi import APIRouter
from std_srvs.srv import SetBool

from panel.ros import client_of

router = APIRouter()


@router.post('/light')
async def light(data):
    return client_of(SetBool, '/light')
