# SPDX-License-Identifier: Apache-2.0
"""The program `xacro`: PyPI's xacro, with errors that name file, line, cause and a way out."""

from __future__ import annotations

from xacro_program.cli import main

__all__ = ['main']
