# SPDX-License-Identifier: Apache-2.0
"""Perform a list of substitutions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from launch.substitution import Substitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """
    Perform substitutions and concatenate the results.

    Parameters
    ----------
    context
        The launch context.
    subs
        The substitutions, in order.

    """
    return ''.join([context.perform_substitution(sub) for sub in subs])
