# SPDX-License-Identifier: Apache-2.0
"""The fixtures of the displays that show a robot."""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).parent))

from stage import page, stage  # noqa: E402

__all__ = ['page', 'stage']
