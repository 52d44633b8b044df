# SPDX-License-Identifier: Apache-2.0
"""What is said about invalid parameters, and about unknown ones."""

from __future__ import annotations

from collections.abc import Iterable

from humanoid_common.errors import NodeStartError
from humanoid_common.naming import did_you_mean


class ParameterError(NodeStartError):
    """
    The values of one or several parameters are invalid.

    Raise it in `__post_init__` of a parameter dataclass to reject inconsistent values. `reason` is
    the message, a full sentence, and `names` are the parameters concerned.
    """

    def __init__(self, reason: str, *names: str) -> None:
        super().__init__(reason)
        self.reason = reason
        self.names = names

    def within(self, group: str) -> ParameterError:
        """
        Return the same error with the full names of the parameters of a group.

        Parameters
        ----------
        group
            The name of the group, which its own check does not know.

        """
        reason = self.reason
        for name in self.names:
            reason = reason.replace(f"'{name}'", f"'{group}.{name}'")
        return ParameterError(reason, *(f'{group}.{name}' for name in self.names))


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
