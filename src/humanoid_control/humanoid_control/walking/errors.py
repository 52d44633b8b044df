# SPDX-License-Identifier: Apache-2.0
"""The error of the walk whose message is meant for users."""

from humanoid_common.errors import UserError


class WalkingError(UserError):
    """An input that walking cannot handle; the message states which, and why."""
