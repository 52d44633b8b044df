# SPDX-License-Identifier: Apache-2.0
"""Errors whose messages are meant for users."""

from __future__ import annotations


class UserError(Exception):
    """
    What was given cannot be used.

    The message is shown to the user as it is: sentences that state what is wrong and what to do.
    """


class NodeStartError(UserError):
    """A node cannot start, or cannot continue."""
