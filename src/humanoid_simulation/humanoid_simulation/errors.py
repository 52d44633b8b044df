# SPDX-License-Identifier: Apache-2.0
"""The error of this package, for users, and the look-up by name that raises it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from humanoid_common.errors import UserError

T = TypeVar('T')


class SimulationError(UserError):
    """A request that the simulator rejects, or a failure; its message is meant for users."""


class ResourceError(SimulationError):
    """A resource cannot be loaded; `problem` names a constant of LoadWorld and SpawnEntity."""

    def __init__(self, problem: str, sentence: str) -> None:
        super().__init__(sentence)
        self.problem = problem


def named(kind: str, name: str, things: Mapping[str, T]) -> T:
    """
    Look up an entry by name; an unknown name is rejected with a suggestion.

    Parameters
    ----------
    kind
        Kind of the entry, for the error message, such as `joint` or `scene`.
    name
        The name that was given, perhaps by a user.
    things
        The entries that can be chosen, by name.

    Returns
    -------
    T
        The entry of that name.

    Raises
    ------
    SimulationError
        There is no such entry; the message names the closest one, or all of them.

    """
    if name in things:
        return things[name]
    from humanoid_common.naming import did_you_mean, shortened

    known = ', '.join(f"'{other}'" for other in things) or 'none'
    hint = did_you_mean(name, things) or f'Available: {known}.'
    raise SimulationError(f"There is no {kind} '{shortened(name)}'. {hint}")
