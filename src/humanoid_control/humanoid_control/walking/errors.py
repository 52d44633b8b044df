# SPDX-License-Identifier: Apache-2.0
"""What goes wrong in walking."""


class WalkingError(ValueError):
    """Something that nobody can walk with was given; the message says what, and why."""
