# SPDX-License-Identifier: Apache-2.0
"""Validation of the names and positions of a joint state."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

__all__ = ['UnusableStateError', 'usable_positions']


class UnusableStateError(ValueError):
    """Raised, with the reason, if a joint state is rejected."""


def usable_positions(
    names: Sequence[str], positions: Sequence[float]
) -> tuple[tuple[str, ...], Sequence[float]]:
    """
    Drop the non-finite positions of a joint state, together with their names.

    Sources publish NaN for unknown positions.

    Parameters
    ----------
    names
        The joints of the message.
    positions
        Their positions, in rad or m.

    Returns
    -------
    tuple
        The remaining names and positions, in the original order.

    Raises
    ------
    UnusableStateError
        The numbers of positions and names differ.

    """
    if len(positions) != len(names):
        raise UnusableStateError(_mismatch(names, positions))
    if isfinite(sum(positions)):
        return tuple(names), positions
    pairs = [(name, value) for name, value in zip(names, positions) if isfinite(value)]
    return tuple(name for name, _ in pairs), [value for _, value in pairs]


def _mismatch(names: Sequence[str], positions: Sequence[float]) -> str:
    about = ', '.join(f"'{name}'" for name in names)
    if not positions:
        return f'A joint state about {about} has no positions, and is left out.'
    return (
        f'A joint state has {len(names)} names but {len(positions)} positions, and is left out; '
        f'it is about {about or "no joint"}.'
    )
