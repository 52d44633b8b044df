# SPDX-License-Identifier: Apache-2.0
"""Diagnostic status of the components of a robot."""

from robot_console.diagnostics.condition import Condition, ERROR, OK, STALE, WARN
from robot_console.diagnostics.diagnostic_book import DiagnosticBook

__all__ = ['ERROR', 'OK', 'STALE', 'WARN', 'Condition', 'DiagnosticBook']
