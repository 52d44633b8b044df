# SPDX-License-Identifier: Apache-2.0
"""The fixtures of the displays that show messages."""

from pathlib import Path
import sys

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent / 'robot')]

from message_stage import message_stage  # noqa: E402
from stage import page  # noqa: E402

__all__ = ['message_stage', 'page']
