# SPDX-License-Identifier: Apache-2.0
"""The stage for displays, which those of the robot are tested on too."""

from pathlib import Path
import sys

HERE = Path(__file__).parent
UNDERLAY = HERE.parents[2]
sys.path[:0] = [str(HERE), str(UNDERLAY / 'rviz_default_plugins' / 'test' / 'robot')]

from console_stage import page, stage  # noqa: E402

__all__ = ['page', 'stage']
