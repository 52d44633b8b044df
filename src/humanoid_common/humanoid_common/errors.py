# SPDX-License-Identifier: Apache-2.0
"""The error whose message is meant for users."""

from __future__ import annotations


class UserError(Exception):
    """
    What was given cannot be used, or the work cannot continue.

    The message is shown to the user as it is: sentences that state what is wrong and what to do.
    `humanoid_common.running.run_node` ends a node with it.
    """
