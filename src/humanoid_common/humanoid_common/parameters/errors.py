# SPDX-License-Identifier: Apache-2.0
"""Error about invalid parameters."""

from __future__ import annotations

from humanoid_common.errors import NodeStartError


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
