# SPDX-License-Identifier: Apache-2.0
"""Run the program as `python3 -m xacro_program FILE [NAME:=VALUE ...]`."""

from __future__ import annotations

import sys

from xacro_program.cli import main

sys.exit(main())
