# SPDX-License-Identifier: Apache-2.0
"""Work in steps, between which other callbacks can run."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

__all__ = ['finish']

ResultT = TypeVar('ResultT')


def finish(work: Generator[None, None, ResultT]) -> ResultT:
    """
    Run a generator to its end in one step.

    Parameters
    ----------
    work
        The generator, such as that of `GlobalPlanner.create_plan`.

    Returns
    -------
    ResultT
        The return value of the generator.

    """
    while True:
        try:
            next(work)
        except StopIteration as stop:
            result: ResultT = stop.value
            return result
