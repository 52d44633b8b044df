# SPDX-License-Identifier: Apache-2.0
"""Errors that end a node with a message."""

from __future__ import annotations


class NodeStartError(Exception):
    """
    A node cannot start, or cannot continue.

    The message is shown to the user as it is: sentences that state what is wrong and what to do.
    """
