# SPDX-License-Identifier: Apache-2.0
"""What the services have in common: converted requests, and results with a code and a message."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.state import EntityState
from humanoid_simulation.errors import ResourceError, SimulationError
import numpy as np
from simulation_interfaces.msg import EntityState as EntityStateMessage
from simulation_interfaces.msg import Result

Do = Callable[[Any, Any], None]
"""Fills the response to a request, or raises SimulationError."""


class RequestError(SimulationError):
    """
    A rejected request, with a result code for programs.

    Parameters
    ----------
    result
        The code: a constant of `Result`, or of the response of the service.
    sentence
        Message for users.

    """

    def __init__(self, result: int, sentence: str) -> None:
        super().__init__(sentence)
        self.result = result


@contextmanager
def refusing(number: int) -> Iterator[None]:
    """
    Turn a SimulationError of a `with` block into a RequestError with a result code.

    Parameters
    ----------
    number
        The code: a constant of `Result`, or of the response of the service.

    Raises
    ------
    RequestError
        The block raised SimulationError; the message is the same.

    """
    try:
        yield
    except SimulationError as error:
        raise RequestError(number, str(error)) from error


@contextmanager
def refusing_resource(response: Any) -> Iterator[None]:
    """
    Turn a ResourceError of a `with` block into a RequestError with its result code.

    Parameters
    ----------
    response
        Class of the response, which has the constant that `ResourceError.problem` names.

    Raises
    ------
    RequestError
        The block raised ResourceError; the message is the same.

    """
    try:
        yield
    except ResourceError as error:
        raise RequestError(getattr(response, error.problem), str(error)) from error


def answering(do: Do) -> Callable[[Any, Any], Any]:
    """
    Make a service callback that reports a SimulationError in the result of the response.

    Parameters
    ----------
    do
        Fills the response; on success the result is set to `RESULT_OK` after it.

    Returns
    -------
    Callable
        A callback for `Node.create_service`; other exceptions pass through it.

    """
    return partial(_answer, do)


def answering_later(do: Callable[[Any, Any], Awaitable[None]]) -> Callable[..., Awaitable[Any]]:
    """
    Make an asynchronous service callback, which answers when a coroutine has ended.

    Parameters
    ----------
    do
        Coroutine function that fills the response, or raises SimulationError.

    Returns
    -------
    Callable
        A callback for `create_async_service`; as for `answering` otherwise.

    """
    return partial(_answer_later, do)


def failure(error: SimulationError) -> Result:
    """
    Make the Result message of an error.

    Parameters
    ----------
    error
        The error; the code is that of a RequestError, else `RESULT_OPERATION_FAILED`.

    """
    number = getattr(error, 'result', Result.RESULT_OPERATION_FAILED)
    return Result(result=number, error_message=str(error))


def entity_state(message: EntityStateMessage) -> EntityState:
    """
    Convert a message to an EntityState, without its header and its accelerations.

    Parameters
    ----------
    message
        Pose and twist, both in the frame of its header.

    Returns
    -------
    EntityState
        Still in the frame of the header; accelerations are zero.

    Raises
    ------
    SimulationError
        A number is not finite, or the quaternion is not normalised.

    """
    pose, twist = message.pose, message.twist
    q = pose.orientation
    return EntityState(
        vector(pose.position),
        np.array([q.w, q.x, q.y, q.z]),
        vector(twist.linear),
        vector(twist.angular),
    )


def vector(message: Any) -> Array:
    """
    Convert a geometry message with x, y and z to an array (3,).

    Parameters
    ----------
    message
        A `Point` or a `Vector3`.

    """
    return np.array([message.x, message.y, message.z])


def _answer(do: Do, request: Any, response: Any) -> Any:
    """Fill the response; an error becomes its result."""
    try:
        do(request, response)
        response.result.result = Result.RESULT_OK
    except SimulationError as error:
        response.result = failure(error)
    return response


async def _answer_later(
    do: Callable[[Any, Any], Awaitable[None]], request: Any, response: Any
) -> Any:
    """Fill the response when the coroutine has ended; an error becomes its result."""
    try:
        await do(request, response)
        response.result.result = Result.RESULT_OK
    except SimulationError as error:
        response.result = failure(error)
    return response
