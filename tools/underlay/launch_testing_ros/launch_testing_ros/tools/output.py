# SPDX-License-Identifier: Apache-2.0
"""Filter the output of ROS nodes independently of the RMW implementation."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import re
from typing import Optional, Union

from launch_testing.tools.output import (
    basic_output_filter as basic_filter,
)
from launch_testing.tools.output import (
    get_default_filtered_patterns,
    get_default_filtered_prefixes,
)

__all__ = ['basic_output_filter']

_PREFIXES = {
    'rmw_connextdds': ['[D', 'RTI Data Distribution Service', 'Expires on'],
    'rmw_fastrtps_cpp': [],
    'rmw_fastrtps_dynamic_cpp': [],
    'rmw_cyclonedds_cpp': [],
}


def basic_output_filter(
    filtered_prefixes: Optional[Iterable[str]] = None,
    filtered_patterns: Optional[Iterable[Union[str, re.Pattern[str]]]] = None,
    filtered_rmw_implementation: Optional[str] = None,
) -> Callable[[str], str]:
    """
    Return a function that removes lines from an output, including those of the middleware.

    Parameters
    ----------
    filtered_prefixes
        The prefixes of lines to remove; None or empty for the defaults.
    filtered_patterns
        Regular expressions of lines to remove, matched from the start; None or empty for the
        defaults.
    filtered_rmw_implementation
        The RMW implementation whose known lines are removed, such as `rmw_connextdds`.

    """
    prefixes = [*(filtered_prefixes or get_default_filtered_prefixes())]
    patterns = [*(filtered_patterns or get_default_filtered_patterns())]
    prefixes += _PREFIXES.get(filtered_rmw_implementation or '', [])
    return basic_filter(prefixes, patterns)
