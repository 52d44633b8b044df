# SPDX-License-Identifier: Apache-2.0
"""The errors that end a node with a sentence."""

from __future__ import annotations


class NodeStartError(Exception):
    """
    Tell why a node cannot start, or go on.

    The text is shown to the user as it is: sentences that say what is wrong and what to do.
    """
