# SPDX-License-Identifier: Apache-2.0
"""Look up entries by name, with a suggestion for a misspelt one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from humanoid_common.naming import did_you_mean, shortened
from humanoid_simulation.errors import SimulationError

T = TypeVar('T')


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
    known = ', '.join(f"'{other}'" for other in things) or 'none'
    hint = did_you_mean(name, things) or f'There are: {known}.'
    raise SimulationError(f"There is no {kind} '{shortened(name)}'. {hint}")
