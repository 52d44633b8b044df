# SPDX-License-Identifier: Apache-2.0
"""The errors of navigation: sentences, and the code with which an action tells them."""

from __future__ import annotations

__all__ = ['ActionAborted', 'ConfigurationError', 'NavigationError']


class NavigationError(Exception):
    """The base of what navigation raises; its text is a sentence for a person."""


class ConfigurationError(NavigationError):
    """A node cannot be configured with its parameters, or activated."""


class ActionAborted(NavigationError):
    """
    A goal of an action cannot be reached.

    Parameters
    ----------
    code
        The error code of the action's result, such as `ComputePathToPose.Result.NO_VALID_PATH`.
    message
        Why, as a sentence: the `error_msg` of the result. It must not be empty.

    """

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code
