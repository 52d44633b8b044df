# SPDX-License-Identifier: Apache-2.0
"""The log of the launch: the screen, and files in a folder of their own for each run."""

from __future__ import annotations

from ._config import get_logger, launch_config, log_launch_config, reset
from ._output import get_output_loggers

__all__ = [
    'get_logger',
    'get_output_loggers',
    'launch_config',
    'log_launch_config',
    'reset',
]
