# SPDX-License-Identifier: Apache-2.0
"""Warnings about values of unknown parameters."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_common.naming import did_you_mean


def unknown_parameter_warnings(given: Iterable[str], known: Iterable[str]) -> list[str]:
    """
    Build a warning for each parameter that was set but does not exist.

    Parameters
    ----------
    given
        Names of the parameters that were set.
    known
        Names of the parameters of the node.

    Returns
    -------
    list of str
        One message per name, in alphabetical order.

    """
    names = sorted(known)
    return [_warning(name, names) for name in sorted(set(given) - set(names))]


def _warning(name: str, known: list[str]) -> str:
    """Build the warning for one unknown name."""
    groups = sorted({each.partition('.')[0] + '.*' if '.' in each else each for each in known})
    advice = did_you_mean(name, known) or f'It has: {", ".join(groups)}.'
    return f"Ignored the value of '{name}': this node has no such parameter. {advice}"
