# SPDX-License-Identifier: Apache-2.0
"""The base class of all substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Substitution:
    """A text that is known only when the launch runs."""

    _is_constant = False  # whether it depends only on what is installed, and changes nothing

    def perform(self, context: LaunchContext) -> str:
        """Return the text; subclasses override this."""
        raise NotImplementedError(
            f"the substitution class '{type(self).__name__}' does not define perform(context)"
        )

    def describe(self) -> str:
        """Return a short description for people."""
        return repr(self)
