# SPDX-License-Identifier: Apache-2.0
"""Log messages of nodes, and notifications of errors."""

from robot_console.log.interruptions import Interruptions
from robot_console.log.log_book import LogBook, LogLine

__all__ = ['Interruptions', 'LogBook', 'LogLine']
