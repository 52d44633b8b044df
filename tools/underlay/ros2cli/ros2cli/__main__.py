# SPDX-License-Identifier: Apache-2.0
"""Run the command line with `python3 -m ros2cli`."""

from ros2cli.cli import run

run()
