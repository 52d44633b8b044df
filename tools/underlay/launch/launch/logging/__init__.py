# SPDX-License-Identifier: Apache-2.0  # noqa: A005, RUF100
"""The log of a launch: the screen, and files in a directory for each run."""

from __future__ import annotations

from launch.logging._config import get_logger, launch_config, log_launch_config, reset
from launch.logging._output import get_output_loggers

__all__ = [
    'get_logger',
    'get_output_loggers',
    'launch_config',
    'log_launch_config',
    'reset',
]
