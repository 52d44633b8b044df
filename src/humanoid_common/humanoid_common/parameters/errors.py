# SPDX-License-Identifier: Apache-2.0
"""The error that refuses a parameter."""

from __future__ import annotations

from humanoid_common.errors import NodeStartError


class ParameterError(NodeStartError):
    """
    Refuse the values of one or several parameters.

    Raise it in `__post_init__` of a parameter dataclass to refuse values that do not fit
    together.
    """

    def __init__(self, reason: str, *names: str) -> None:
        """Keep the reason, a full sentence, and the names of the parameters concerned."""
        super().__init__(reason)
        self.reason = reason
        self.names = names
