# SPDX-License-Identifier: Apache-2.0
"""Work that is done in steps, so that others have their turn between them."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

__all__ = ['finish']

ResultT = TypeVar('ResultT')


def finish(work: Generator[None, None, ResultT]) -> ResultT:
    """
    Run a generator to its end at one go.

    Parameters
    ----------
    work
        Such as `GlobalPlanner.create_plan` makes.

    Returns
    -------
    ResultT
        What the generator returns.

    """
    while True:
        try:
            next(work)
        except StopIteration as stop:
            result: ResultT = stop.value
            return result
