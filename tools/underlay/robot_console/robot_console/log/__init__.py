# SPDX-License-Identifier: Apache-2.0
"""What nodes say, and which of it is worth an interruption."""

from robot_console.log.interruptions import Interruptions
from robot_console.log.log_book import LogBook, LogLine

__all__ = ['Interruptions', 'LogBook', 'LogLine']
