# SPDX-License-Identifier: Apache-2.0
"""Run the command line with `python3 -m ros2cli`."""

from ros2cli.start_up import prepare

prepare()
from ros2cli.cli import run  # noqa: E402, I100

run()
