# SPDX-License-Identifier: Apache-2.0
"""How the parts of a robot are."""

from robot_console.diagnostics.condition import Condition, ERROR, OK, STALE, WARN
from robot_console.diagnostics.diagnostic_book import DiagnosticBook

__all__ = ['ERROR', 'OK', 'STALE', 'WARN', 'Condition', 'DiagnosticBook']
