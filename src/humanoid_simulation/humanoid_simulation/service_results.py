# SPDX-License-Identifier: Apache-2.0
"""Answer requests of `simulation_interfaces`: every response has a result with a sentence."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.resources import ResourceError
from simulation_interfaces.msg import Result

Do = Callable[[Any, Any], None]
"""Fills the response to a request, or raises SimulationError."""


class Refusal(SimulationError):
    """A request that is not fulfilled, with the number that says why to programs."""

    def __init__(self, result: int, sentence: str) -> None:
        """Take a constant of Result, or of the service, and a sentence for people."""
        super().__init__(sentence)
        self.result = result


@contextmanager
def refusing(number: int) -> Iterator[None]:
    """Let an error in a `with` block become a refusal with a number."""
    try:
        yield
    except SimulationError as error:
        raise Refusal(number, str(error)) from error


@contextmanager
def refusing_resource(response: Any) -> Iterator[None]:
    """Let a resource that is at fault become a refusal with a constant of a response."""
    try:
        yield
    except ResourceError as error:
        raise Refusal(getattr(response, error.problem), str(error)) from error


def answering(do: Do) -> Callable[[Any, Any], Any]:
    """Return the callback of a service, which never fails."""
    return partial(_answer, do)


def answering_later(do: Callable[[Any, Any], Awaitable[None]]) -> Callable[..., Awaitable[Any]]:
    """Return the callback of a service that takes its time."""
    return partial(_answer_later, do)


def failure(error: SimulationError) -> Result:
    """Return the result that tells of an error."""
    number = getattr(error, 'result', Result.RESULT_OPERATION_FAILED)
    return Result(result=number, error_message=str(error))


def _answer(do: Do, request: Any, response: Any) -> Any:
    """Answer at once."""
    try:
        do(request, response)
        response.result.result = Result.RESULT_OK
    except SimulationError as error:
        response.result = failure(error)
    return response


async def _answer_later(
    do: Callable[[Any, Any], Awaitable[None]], request: Any, response: Any
) -> Any:
    """Answer when it is done."""
    try:
        await do(request, response)
        response.result.result = Result.RESULT_OK
    except SimulationError as error:
        response.result = failure(error)
    return response
