# SPDX-License-Identifier: Apache-2.0
"""Errors of navigation: messages, and the error codes of actions."""

from __future__ import annotations

__all__ = ['ActionAborted', 'ConfigurationError', 'NavigationError']


class NavigationError(Exception):
    """The base class of navigation errors; the text is a full sentence for users."""


class ConfigurationError(NavigationError):
    """A node cannot be configured or activated with its parameters."""


class ActionAborted(NavigationError):
    """
    An action goal is aborted.

    Parameters
    ----------
    code
        The error code of the action's result, such as `ComputePathToPose.Result.NO_VALID_PATH`.
    message
        The reason in a full sentence: the `error_msg` of the result. It must not be empty.

    """

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code
