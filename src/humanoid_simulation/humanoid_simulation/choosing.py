# SPDX-License-Identifier: Apache-2.0
"""Choose a thing by its name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from humanoid_common.naming import did_you_mean, shortened
from humanoid_simulation.errors import SimulationError

T = TypeVar('T')


def named(kind: str, name: str, things: Mapping[str, T]) -> T:
    """Return the thing of a name; an unknown name is refused with the names that there are."""
    if name in things:
        return things[name]
    known = ', '.join(f"'{other}'" for other in things) or 'none'
    hint = did_you_mean(name, things) or f'There are: {known}.'
    raise SimulationError(f"There is no {kind} '{shortened(name)}'. {hint}")
