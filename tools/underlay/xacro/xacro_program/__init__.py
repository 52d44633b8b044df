# SPDX-License-Identifier: Apache-2.0
"""The program `xacro`: xacro from PyPI, with errors that state file, line, cause and a fix."""

from __future__ import annotations

from xacro_program.cli import main

__all__ = ['main']
